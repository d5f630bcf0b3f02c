#!/usr/bin/env python3
"""Recordings of one motor under one load as two dozen loggers write them: names, units, separators, marks, clocks
and lines about themselves. loggers.py FOLDER: writes machine/ and the logs; the names of the logs are printed."""
import math
import os
import random
import sys

P, K, R = 4, 0.28, 0.5  # pole pairs, V·s/rad, ohm
N, STEP_S, RPM, IQ, ID = 600, 0.002, 61.0, 5.0, -1.0


def motor(seed):
    """Samples of a motor that turns steadily: time, mechanical angle, speed, phases, torque, voltages."""
    draw = random.Random(seed)
    omega = RPM * 2 * math.pi / 60
    for k in range(N):
        t = k * STEP_S
        m = 0.37 + omega * t
        e = P * m
        turn = [e - 2 * math.pi * s / 3 for s in range(3)]
        i = [IQ * math.sin(x) - ID * math.cos(x) for x in turn]
        v = [omega * K * math.sin(x) + R * y for x, y in zip(turn, i)]
        yield {
            "t": t, "m": m, "e": e, "rpm": RPM + draw.gauss(0, 0.02),
            "i": [x + draw.gauss(0, 0.01) for x in i], "v": [x + draw.gauss(0, 0.02) for x in v],
            "id": ID + draw.gauss(0, 0.01), "iq": IQ + draw.gauss(0, 0.01),
            "T": 1.5 * K * IQ + 0.03 * math.sin(6 * e) + draw.gauss(0, 0.004)}


def number(x, digits, mark=".", thousands=""):
    text = f"{x:,.{digits}f}"
    return text.replace(",", "\0").replace(".", mark).replace("\0", thousands)


def clock(t, mark=".", digits=3, begin_s=9 * 3600 + 12 * 60 + 58.5):
    t = round(begin_s + t, digits)
    return f"{int(t // 3600):02d}:{int(t % 3600 // 60):02d}:" + f"{t % 60:0{3 + digits}.{digits}f}".replace(".", mark)


def degrees(x):
    return math.degrees(x)


def table(names, separator, row, before=(), after=(), end="\n"):
    lines = list(before) + [separator.join(names)] if names else list(before)
    lines += list(after) + [separator.join(row(s)) for s in motor(5)]
    return end.join(lines) + end


def twincat():
    """TwinCAT 3 Scope: columns of attributes below the names, one column of time."""
    names = ["Winkel mech.", "Istdrehzahl", "Strom U", "Strom V", "Strom W", "Drehmoment"]
    units = ["° (Angle)", "1/min (Velocity)", "A (Current)", "A (Current)", "A (Current)", "Nm (Torque)"]
    attribute = lambda name, values: "\t".join([name] + values)
    same = lambda name, value: attribute(name, [value] * len(names))
    before = ["Name\tPruefstand", "File\tC:\\Messung\\Pruefstand.csv",
              "Starttime of export\t132959733843760000\tMontag, 2. Mai 2022\t15:56:24.376",
              "Endtime of export\t132959733853750000\tMontag, 2. Mai 2022\t15:56:26.776", "", ""]
    after = [same("SymbolComment", ""), same("Data-Type", "REAL64"), same("SampleTime[ms]", "2"),
             same("VariableSize", "8"), same("SymbolBased", "True"), same("IndexGroup", "16448"),
             attribute("IndexOffset", [str(385000 + 8 * k) for k in range(6)]),
             attribute("SymbolName", [f"MAIN.f{k}" for k in range(6)]), same("NetID", "192.168.1.20.1.1"),
             same("Port", "851"), same("Offset", "0"), same("ScaleFactor", "1"),
             same("BitMask", "0xffffffffffffffff"), attribute("Unit", units), same("Unit ScaleFactor", "1"),
             same("Unit Offset", "0"), ""]
    row = lambda s: [number(1e3 * s["t"], 0), number(degrees(s["m"]) % 360, 4), number(s["rpm"], 3)] + \
        [number(x, 4) for x in s["i"]] + [number(s["T"], 5)]
    return table(["Name"] + names, "\t", row, before, after, "\r\n").encode()


def labview_german():
    """LabVIEW .lvm with decimal commas: two heads, then X_Value and the channels."""
    head = ["LabVIEW Measurement\t", "Writer_Version\t2", "Reader_Version\t2", "Separator\tTab",
            "Decimal_Separator\t,", "Multi_Headings\tNo", "X_Columns\tOne", "Time_Pref\tAbsolute", "Operator\tLabor",
            "Date\t2024/03/01", "Time\t09:12:58,5", "***End_of_Header***\t", "", "Channels\t6\t\t\t\t\t\t",
            "Samples" + "\t600" * 6, "Date" + "\t2024/03/01" * 6, "Time" + "\t09:12:58,5" * 6,
            "X_Dimension" + "\tTime" * 6, "X0" + "\t0,0000000000000000E+0" * 6, "Delta_X" + "\t2,000000E-3" * 6,
            "***End_of_Header***" + "\t" * 6]
    names = ["X_Value", "Drehwinkel (Grad)", "Drehzahl (1/min)", "Phasenstrom U (A)", "Phasenstrom V (A)",
             "Phasenstrom W (A)", "Moment (Nm)", "Comment"]
    row = lambda s: [number(s["t"], 6, ","), number(degrees(s["m"]), 4, ","), number(s["rpm"], 3, ",")] + \
        [number(x, 4, ",") for x in s["i"]] + [number(s["T"], 5, ","), ""]
    return table(names, "\t", row, head, end="\r\n").encode("cp1252")


def famos():
    """imc FAMOS: names, then units, Windows-1252."""
    names = ["Zeit", "Rotorwinkel mech.", "Drehzahl", "Strom_L1", "Strom_L2", "Strom_L3", "Drehmoment"]
    units = ["s", "Grad", "U/min", "A", "A", "A", "N·m"]
    row = lambda s: [number(s["t"], 4, ","), number(degrees(s["m"]) % 360, 3, ","), number(s["rpm"], 2, ",")] + \
        [number(x, 4, ",") for x in s["i"]] + [number(s["T"], 5, ",")]
    return table(names, ";", row, after=[";".join(units)], end="\r\n").encode("cp1252")


def catman():
    """HBM catman, ASCII with channel information."""
    names = ["Zeit  1 - Standardmessrate [s]", "T40B Drehmoment [N*m]", "T40B Drehzahl [1/min]", "T40B Drehwinkel [°]",
             "I_U [A]", "I_V [A]", "I_W [A]"]
    row = lambda s: [number(s["t"], 6, ","), number(s["T"], 5, ","), number(s["rpm"], 3, ","),
                     number(degrees(s["m"]) % 360, 3, ",")] + [number(x, 5, ",") for x in s["i"]]
    return table(names, "\t", row, ["HBM_CATMAN_DATAFILE_40", "Prüfling 7", ""], end="\r\n").encode("cp1252")


def excel_german():
    names = ["Uhrzeit", "Mech. Winkel [°]", "Drehzahl [U/min]", "Phasenstrom 1 [A]", "Phasenstrom 2 [A]",
             "Phasenstrom 3 [A]", "Drehmoment gemessen [Nm]"]
    row = lambda s: [clock(s["t"], ","), number(degrees(s["m"]), 3, ",", "."), number(s["rpm"], 2, ",")] + \
        [number(x, 3, ",") for x in s["i"]] + [number(s["T"], 4, ",")]
    return table(names, ";", row, ["Prüfstand 3;;;;;;", ";;;;;;"], end="\r\n").encode("cp1252")


def excel_french():
    names = ["Heure", "Position angulaire [°]", "Vitesse [tr/min]", "Courant phase 1 [A]", "Courant phase 2 [A]",
             "Courant phase 3 [A]", "Couple mesuré [N.m]"]
    row = lambda s: [clock(s["t"], ","), number(degrees(s["m"]), 3, ",", "\xa0"), number(s["rpm"], 2, ",")] + \
        [number(x, 3, ",") for x in s["i"]] + [number(s["T"], 4, ",")]
    return table(names, ";", row, ["Banc d'essai n° 3", "Date;01/03/2024", ""], end="\r\n").encode("cp1252")


def labview_spanish():
    names = ["Tiempo (s)", "Posición angular (°)", "Velocidad (rpm)", "Corriente fase A (A)", "Corriente fase B (A)",
             "Corriente fase C (A)", "Par medido (N·m)"]
    row = lambda s: [number(s["t"], 4), number(degrees(s["m"]), 3), number(s["rpm"], 2)] + \
        [number(x, 3) for x in s["i"]] + [number(s["T"], 4)]
    return table(names, ",", row).encode()


def excel_italian():
    names = ["Tempo [s]", "Angolo mecc. [°]", "Velocità [giri/min]", "Corrente fase U [A]", "Corrente fase V [A]",
             "Corrente fase W [A]", "Coppia misurata [Nm]"]
    row = lambda s: [number(s["t"], 4, ","), number(degrees(s["m"]), 3, ","), number(s["rpm"], 2, ",")] + \
        [number(x, 3, ",") for x in s["i"]] + [number(s["T"], 4, ",")]
    return b"\xef\xbb\xbf" + table(names, ";", row, end="\r\n").encode()


def dspace():
    """dSPACE ControlDesk: paths of the model, and a column of time."""
    path = "Model Root/Messung/"
    names = ["Time"] + [f'"{path}{x}"' for x in ["theta_mech [rad]", "n_ist [1/min]", "i_d [A]", "i_q [A]", "M_Welle [Nm]"]]
    row = lambda s: [repr(s["t"]), repr(s["m"]), repr(s["rpm"]), repr(s["id"]), repr(s["iq"]), repr(s["T"])]
    return table(names, ",", row, ['"Experiment","PMSM"', '"Recorder","R1"']).encode()


def scopecorder():
    """Yokogawa DL850: a head of two columns, then the names of the traces with units below."""
    head = ['"Header Size","9"', '"Model Name","DL850E"', '"Block Number","1"', '"Date","2024/03/01"',
            '"Time","09:12:58.500000"', '"HResolution","2.000000E-03"', '"HUnit","s"', '"RecordLength","600"', ""]
    names = ["Time", "Speed", "Torque", "Angle", "U1", "U2", "U3", "I1", "I2", "I3"]
    units = ["s", "rpm", "Nm", "deg", "V", "V", "V", "A", "A", "A"]
    row = lambda s: [f'{s["t"]:.6E}', f'{s["rpm"]:.6E}', f'{s["T"]:.6E}', f'{degrees(s["m"]) % 360:.6E}'] + \
        [f"{x:.6E}" for x in s["v"] + s["i"]]
    return table(names, ",", row, head, [",".join(units)], "\r\n").encode()


def siemens():
    """A trace of a drive: a date and time in one cell, names with their unit behind a comma."""
    names = ["Zeitstempel", "Lageistwert Motor, °", "Drehzahlistwert, 1/min", "Phasenstrom U, A", "Phasenstrom V, A",
             "Phasenstrom W, A", "Drehmomentsensor, Nm"]
    row = lambda s: ["01.03.2024 " + clock(s["t"])] + [number(degrees(s["m"]), 3, ","), number(s["rpm"], 3, ",")] + \
        [number(x, 4, ",") for x in s["i"]] + [number(s["T"], 4, ",")]
    return table(names, ";", row, end="\r\n").encode("utf-16")


def flexlogger():
    """NI FlexLogger: a time of the day, names with units in brackets."""
    names = ["Time", "Encoder Position (deg)", "Rotational Speed (rpm)", "Phase A Current (A)", "Phase B Current (A)",
             "Phase C Current (A)", "Torque Sensor (N·m)"]
    row = lambda s: ["2024-03-01T" + clock(s["t"], digits=6), f'{degrees(s["m"]):.6f}', f'{s["rpm"]:.6f}'] + \
        [f"{x:.6f}" for x in s["i"]] + [f'{s["T"]:.6f}']
    return table(names, ",", row).encode()


def kistler():
    names = ["t [s]","n [1/min]","Md [Nm]","phi_mech [°]","I_U [A]","I_V [A]","I_W [A]"]
    return table(names, ";",lambda s:[number(s["t"],4,","),number(s["rpm"],2,","),number(s["T"],4,","),number(degrees(s["m"])%360,3,",")]+[number(x,3,",") for x in s["i"]],end="\r\n").encode("cp1252")


def kollmorgen():
    names = ["Time (ms)","IU (A)","IV (A)","IW (A)","Velocity Feedback (rpm)","Mechanical Position (deg)","External Torque (Nm)"]
    return table(names, ",",lambda s:[f'{1e3*s["t"]:.3f}']+[f"{x:.4f}" for x in s["i"]]+[f'{s["rpm"]:.3f}',f'{degrees(s["m"])%360:.4f}',f'{s["T"]:.5f}']).encode()


def matlab():
    names = ["Time_s","ThetaMech_deg","Speed_rpm","Ia_A","Ib_A","Ic_A","TorqueMeas_Nm"]
    return table(names, ",",lambda s:[f'{s["t"]:.4f}',f'{degrees(s["m"]):.4f}',f'{s["rpm"]:.3f}']+[f"{x:.4f}" for x in s["i"]]+[f'{s["T"]:.5f}']).encode()


def pandas():
    names = ["","timestamp","rotor_angle_mech_deg","motor_speed_rpm","phase_a_current","phase_b_current","phase_c_current","torque_sensor_nm"]
    k=[-1]
    def row(s): k[0]+=1; return [str(k[0]),"2024-03-01 "+clock(s["t"],digits=6),repr(degrees(s["m"])),repr(s["rpm"])]+[repr(x) for x in s["i"]]+[repr(s["T"])]
    return table(names, ",",row).encode()


def german_in():
    names = ["Zeit in s","Winkel mech. in °","Drehzahl in 1/min","Strom Phase U in A","Strom Phase V in A","Strom Phase W in A","Drehmoment in Nm"]
    return table(names, "\t",lambda s:[number(s["t"],4,","),number(degrees(s["m"]),3,","),number(s["rpm"],2,",")]+[number(x,3,",") for x in s["i"]]+[number(s["T"],4,",")],end="\r\n").encode("utf-16")


def french2():
    names = ["Temps écoulé (s)","Angle rotor mécanique (°)","Vitesse de rotation (tr/min)","Courant phase U (A)","Courant phase V (A)","Courant phase W (A)","Couple arbre (N·m)"]
    return table(names, ";",lambda s:[number(s["t"],4,","),number(degrees(s["m"]),3,","),number(s["rpm"],2,",")]+[number(x,3,",") for x in s["i"]]+[number(s["T"],4,",")],end="\r\n").encode("utf-8")


def spanish2():
    names = ["Hora","Ángulo mecánico (grados)","Velocidad de giro (rpm)","Intensidad fase 1 (A)","Intensidad fase 2 (A)","Intensidad fase 3 (A)","Par motor (Nm)"]
    return table(names, ";",lambda s:[clock(s["t"],","),number(degrees(s["m"]),3,","),number(s["rpm"],2,",")]+[number(x,3,",") for x in s["i"]]+[number(s["T"],4,",")],end="\r\n").encode("cp1252")


def italian2():
    names = ["Tempo (ms)","Posizione angolare (gradi)","Velocità albero (giri/min)","Corrente di fase R (A)","Corrente di fase S (A)","Corrente di fase T (A)","Coppia (Nm)"]
    return table(names, ";",lambda s:[number(1e3*s["t"],1,","),number(degrees(s["m"]),3,","),number(s["rpm"],2,",")]+[number(x,3,",") for x in s["i"]]+[number(s["T"],4,",")]).encode("cp1252")


def codesys():
    names = ["Time [ms]","fMechAngle [deg]","fActVelocity [rpm]","fIq [A]","fId [A]","fTorqueSensor [Nm]"]
    return table(names, ";",lambda s:[f'{1e3*s["t"]:.1f}',f'{degrees(s["m"]):.4f}',f'{s["rpm"]:.3f}',f'{s["iq"]:.4f}',f'{s["id"]:.4f}',f'{s["T"]:.5f}'],["Trace1","Sample rate;2 ms"]).encode()


def diadem():
    names = ["Messzeit","Drehzahl Welle","Drehwinkel Welle","Drehmoment Welle","Strom U","Strom V","Strom W"]
    units = ["s","1/min","Grad","N*m","A","A","A"]
    return table(names, "\t",lambda s:[number(s["t"],4,","),number(s["rpm"],2,","),number(degrees(s["m"]),3,","),number(s["T"],4,",")]+[number(x,3,",") for x in s["i"]],after=["\t".join(units)],end="\r\n").encode("cp1252")


def hioki():
    names = ["Date","Time","Angle[deg]","Speed[r/min]","Torque[N*m]","I1[A]","I2[A]","I3[A]"]
    return table(names, ",",lambda s:["2024/03/01",clock(s["t"]),f'{degrees(s["m"])%360:.3f}',f'{s["rpm"]:.3f}',f'{s["T"]:.5f}']+[f"{x:.4f}" for x in s["i"]],["HIOKI PW8001","Ver 1.20",""]).encode()


def inca():
    names = ["time","n_mot","phi_mech","M_Welle","i_u","i_v","i_w"]
    units = ["s","1/min","°","Nm","A","A","A"]
    return table(names, ";",lambda s:[f'{s["t"]:.4f}',f'{s["rpm"]:.3f}',f'{degrees(s["m"])%360:.3f}',f'{s["T"]:.5f}']+[f"{x:.4f}" for x in s["i"]],after=[";".join(units)]).encode()


LOGS = [twincat, labview_german, famos, catman, excel_german, excel_french, labview_spanish, excel_italian,
        dspace, scopecorder, siemens, flexlogger, kistler, kollmorgen, matlab, pandas, german_in, french2,
        spanish2, italian2, codesys, diadem, hioki, inca]


def machine(folder):
    os.makedirs(folder, exist_ok=True)
    with open(os.path.join(folder, "machine.csv"), "w", encoding="utf-8") as f:
        f.write(f"name,value,unit\npole_pairs,{P},1\nresistance,{R},ohm\ninductance_d,1e-6,H\ninductance_q,1e-6,H\n")
    with open(os.path.join(folder, "back_emf.csv"), "w", encoding="utf-8") as f:
        f.write(f"order,amplitude_Nm_per_A,phase_rad\n1,{K},0\n")
    with open(os.path.join(folder, "cogging.csv"), "w", encoding="utf-8") as f:
        f.write("order,amplitude_Nm,phase_rad\n6,0.03,0\n")


def main(out):
    machine(os.path.join(out, "machine"))
    for log in LOGS:
        with open(os.path.join(out, log.__name__ + ".csv"), "wb") as f:
            f.write(log())
        print(log.__name__)


if __name__ == "__main__":
    main(sys.argv[1])
