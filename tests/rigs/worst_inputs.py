"""Writes the inputs of worst_inputs.sh into a folder: worst_inputs.py FOLDER."""
import os
import pathlib
import sys

os.chdir(sys.argv[1])
HARMONIC, CURRENT = "order,amplitude_Nm,phase_rad", "order,set,amplitude_A,phase_rad"
SCENARIO = "name,value,unit\nprescribed_speed,1500,rpm\ntorque_reference,1,Nm\n"


def write(path, header, rows):
    path = pathlib.Path(path)
    path.parent.mkdir(exist_ok=True)
    with path.open("w") as file:
        file.write(header + "\n")
        file.writelines(f"{row}\n" for row in rows)


def machine(name, emf=(), cogging=()):
    write(f"{name}/machine.csv", "name,value,unit", ["pole_pairs,2,1", "resistance,0.5,ohm", "inductance_d,2,mH", "inductance_q,2,mH",
                                                     "inertia,0.001,kgm2", "dc_link_voltage,100,V", "rated_current,10,A"])
    write(f"{name}/back_emf.csv", "order,amplitude_Nm_per_A,phase_rad", emf or ["1,0.2,0", "5,0.01,0.3", "7,0.01,1"])
    write(f"{name}/cogging.csv", HARMONIC, cogging or ["6,0.01,1", "12,0.02,0"])


def recording(path, samples):
    write(path, "time_s,theta_e_rad,ia_A,ib_A,ic_A,torque_Nm", (f"{k * 0.001:.3f},{k * 0.1:.1f},1,-0.5,-0.5,{1 + k % 7 / 10:.1f}" for k in range(samples)))


def orders(count, rest):
    return (f"{k * 2000 / count:.4f},{rest}" for k in range(1, count + 1))


machine("small")
machine("effects")
write("effects/effects.csv", "effect,parameter,value,unit,std_error",
      (f"cogging,{wave}_{k * 0.002:.3f},0.001,Nm," for k in range(1, 500001) for wave in ("sine", "cosine")))
machine("cogging1e6", cogging=orders(1000000, "0.001,0"))
machine("emf2000", [f"{n},{0.2 / n},{n % 6}" for n in range(1, 2001)], [f"{n},{0.1 / n},{n % 6}" for n in range(1, 2001)])
machine("orders2000", ["1,0.2,0", "1999,0.001,0"], ["6,0.01,1", "2000,0.01,0"])
write("target.csv", HARMONIC, ["0,2,0"])
write("target1e6.csv", HARMONIC, orders(1000000, "0.001,0"))
write("line1GB.csv", HARMONIC, ["0," + "1" * 1000000000 + ",0"])
write("set1e5.csv", "order,set", (f"{k / 50},{name}" for k in range(1, 50001) for name in ("pos", "neg")))
write("set2000.csv", "order,set", (f"{k},{name}" for k in range(1, 1001) for name in ("pos", "neg")))
write("currents1e5.csv", CURRENT, orders(100000, "pos,0.001,0"))
write("currents1e4.csv", CURRENT, orders(10000, "pos,0.001,0"))
recording("run1e6.csv", 1000000)
recording("run20.csv", 20)
for k in range(4096):
    recording(f"runs/{k}.csv", 20)
write("runs4096.csv", "file,role", (f"runs/{k}.csv,{'fit' if k % 3 else 'holdout'}" for k in range(4096)))
write("runs1e5.csv", "file,role", (f"runs/{k}.csv,fit" for k in range(100000)))
write("steps1e15.csv", SCENARIO + "duration,1e6,s", ["step,1e-9,s"])
write("steps4e9.csv", SCENARIO + "duration,4,s", ["step,1e-9,s"])
write("grid1e6.csv", "torque_Nm,speed_rpm", (f"{k * 1e-6:.6f},100" for k in range(1, 1000001)))
write("motors1e5.csv", "motor,machine,target", (f"m{k},small,target.csv" for k in range(100000)))
write("fleet1e5/fleet.csv", "motor,serial,batch,date,state,exit_code,verdict,reason,mean_Nm,worst_error_Nm,worst_order,peak_phase_A,loss_ratio_to_plain,words_digest",
      (f"m{k},,,,done,0,reached,,2,0,6,{6.7 + k % 13 / 100:.2f},0.997,1389af16c6d39e29" for k in range(100000)))
