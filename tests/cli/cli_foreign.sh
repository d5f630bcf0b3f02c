#!/bin/sh
# Tables as other tools write them: `predict` and `harmonics` make the same of them as of the same samples in this program's own form.
#   cli_foreign.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
cd "$source_dir" || exit 1

# ---- 400 samples of machine A at 30 rpm, four turns: t theta_m i_d i_q torque ia ib ic va vb vc

awk 'BEGIN { pi = atan2(0, -1); CONVFMT = OFMT = "%.15g"
    for (k = 0; k < 400; ++k) { t = k / 50; m = pi * t + 0.1; e = 2 * m; id = -1 + 0.5 * sin(3 * m); iq = 4 + cos(m)
        torque = 0.2 * iq + 0.05 * sin(12 * e + 0.3) + 0.02 * cos(6 * e) + 0.01
        line = t " " m " " id " " iq " " torque
        for (s = 0; s < 3; ++s) { x = e - s * 2 * pi / 3; line = line " " (iq * sin(x) - id * cos(x)) }
        for (s = 0; s < 3; ++s) { x = e - s * 2 * pi / 3; line = line " " (5 * sin(x) + sin(5 * x)) }
        print line } }' >"$work/samples"

# write FILE PROGRAM: an awk program on the samples, with names for their fields.
write() {
    file=$work/$1
    awk 'BEGIN { pi = atan2(0, -1); CONVFMT = OFMT = "%.15g" }
        function deg(x) { return x * 180 / pi }
        function turns(x) { return x / (2 * pi) }
        function wrapped(x, turn) { return x - turn * int(x / turn) }
        { t = $1; m = $2; id = $3; iq = $4; T = $5; ia = $6; ib = $7; ic = $8; va = $9; vb = $10; vc = $11 }'"$2" "$work/samples" >"$file"
}

# column NAME FILE: the numbers of a column that `predict` added at the end, below a row of units or none.
column() {
    awk -F, -v name="$1" 'NR == 1 { for (k = NF; k > 0 && $k != name; --k) { } from_end = NF - k; next }
        $(NF - from_end) != "Nm" { print $(NF - from_end) }' "$2"
}

same_numbers() {
    paste "$1" "$2" | awk 'function off(a, b) { a -= b; return a < 0 ? -a : a }
        NF != 2 || off($1, $2) > 1e-9 { bad = 1 } END { exit bad || NR < 2 }'
}

write own.csv 'NR == 1 { print "time_s,theta_m_rad,speed_rpm,id_A,iq_A,torque_Nm" } { print t "," m ",30," id "," iq "," T }'
write own_phases.csv 'NR == 1 { print "time_s,theta_m_rad,speed_rpm,ia_A,ib_A,ic_A,torque_Nm" } { print t "," m ",30," ia "," ib "," ic "," T }'
write own_volts.csv 'NR == 1 { print "time_s,va_V,vb_V,vc_V" } { print t "," va "," vb "," vc }'
run 0 predict data/machine_a "$work/own.csv" -q -o "$work/own_predicted.csv"
column torque_model_Nm "$work/own_predicted.csv" >"$work/own_model"
column residual_Nm "$work/own_predicted.csv" >"$work/own_residual"
run 0 harmonics "$work/own.csv" --quantity cogging --pole-pairs 2 --torque-constant 0.2 -q -o "$work/own"
run 0 harmonics "$work/own_volts.csv" --quantity back_emf --pole-pairs 2 -q -o "$work/own"
check "the own form has no orders" [ "$(wc -l <"$work/own/cogging.csv")" -gt 2 ]
run 0 predict data/machine_a "$work/own_phases.csv" -q -o "$work/predicted.csv"
column torque_model_Nm "$work/predicted.csv" >"$work/model"
check "i_d and i_q are not the phase currents" same_numbers "$work/own_model" "$work/model"

# same_model FILE [EXPRESSION...]: `predict` gives the model's torque of the own form, and says the expressions; what it wrote is
# read again with the same result.
same_model() {
    name=$1
    shift
    run 0 predict data/machine_a "$work/$name" -o "$work/predicted.csv"
    [ $# -eq 0 ] || says "$@"
    column torque_model_Nm "$work/predicted.csv" >"$work/model"
    check "$name: another torque" same_numbers "$work/own_model" "$work/model"
    if grep -q residual_Nm "$work/predicted.csv"; then
        column residual_Nm "$work/predicted.csv" >"$work/residual"
        check "$name: another residual" same_numbers "$work/own_residual" "$work/residual"
    fi
    run 0 predict data/machine_a "$work/predicted.csv" -q -o "$work/again.csv"
    check "$name: a prediction of the prediction differs" cmp -s "$work/predicted.csv" "$work/again.csv"
}

# same_orders QUANTITY FILE [EXPRESSION...]: `harmonics` writes the numbers of the own form.
same_orders() {
    quantity=$1 name=$2
    shift 2
    constant=
    [ "$quantity" = back_emf ] || constant="--torque-constant 0.2"
    rm -rf "$work/orders"
    # shellcheck disable=SC2086
    run 0 harmonics "$work/$name" --quantity "$quantity" --pole-pairs 2 $constant -o "$work/orders"
    [ $# -eq 0 ] || says "$@"
    tail -n +2 "$work/own/$quantity.csv" | tr , '\n' >"$work/wanted"
    tail -n +2 "$work/orders/$quantity.csv" | tr , '\n' >"$work/found"
    check "$name: other orders" same_numbers "$work/wanted" "$work/found"
}

# ---- VESC Tool: semicolons, a last one with nothing after it, milliseconds of the day, electrical speed, encoder in degrees

write vesc.csv 'NR == 1 { print "ms_today;input_voltage;temp_mos_max;temp_motor;current_motor;current_in;d_axis_current;q_axis_current;erpm;duty_cycle;encoder_position;fault_code;" }
    { print 43200000 + 1000 * t ";48.1;31.5;40.2;" iq ";1.5;" id ";" iq ";60;0.1;" wrapped(deg(m), 360) ";0;" }'
same_model vesc.csv '`encoder_position` is read as the mechanical angle of an encoder .*, in deg' \
    '`erpm` is read as the electrical speed, divided by the pole pairs, in rpm' 'not used: `input_voltage`, `temp_mos_max`, `current_motor`'
check "the temperature is not that of the motor" eval "! grep -q temp_motor '$work/stderr'"

# ---- a dynamometer: names, then units, one of which is not known here and is not needed

write dyno.csv 'NR == 1 { print "Time,theta_m,Speed,I_d,I_q,Psi_d,Psi_q,Torque,Oil"; print "s,deg,rpm,mA,A,Wb,Wb,N*m,bar" }
    { print t "," deg(m) ",30," 1000 * id "," iq ",0.1,0.02," T ",2.5" }'
same_model dyno.csv 'not used: `Psi_d`, `Psi_q`, `Oil`'
same_orders cogging dyno.csv
write broken_unit.csv 'NR == 1 { print "Time,theta_m,I_q,Torque"; print "s,deg,A,furlong" } { print t "," deg(m) "," iq "," T }'
run 3 predict data/machine_a "$work/broken_unit.csv"
says 'broken_unit.csv:2: column 4 `Torque`: found `furlong`, expected a unit'

# ---- JMAG: lines about the study before the header, units in the names

foreword='NR == 1 { print "Torque"; print "Study,Tran2TSS"; print "Case,1"; print "Slip,0.01"; print "Title,Torque"; print ""; print "Part,Rotor,Stator" }'
write jmag_voltage.csv "$foreword"' NR == 1 { print "Time(s),Terminal-U(V),Terminal-V(mV),Terminal-W" } { print t "," va "," 1000 * vb "," vc }'
same_orders back_emf jmag_voltage.csv 'line 8 is the header' '`Terminal-U\(V\)` is read as the voltage of phase a'
write jmag.csv "$foreword"' NR == 1 { print "Time(s),theta_m(deg),Torque(Nm),Coil-U,Coil-V,Coil-W" }
    { print t "," deg(m) "," T "," ia "," ib "," ic }'
same_model jmag.csv '`Coil-U` is read as the current of phase a, and those after it as b and c, in A'
write jmag_torque.csv "$foreword"' NR == 1 { print "Time(s),Torque(Nm)" } { print t "," T }'
run 3 harmonics "$work/jmag_torque.csv" --quantity cogging --pole-pairs 2
says 'jmag_torque.csv:8: found no angle of the rotor but `Time\(s\)`, `Torque\(Nm\)`, expected a column theta_m or theta_e'
sed '12s/.*/0.06,x,1,1,1,1/' "$work/jmag.csv" >"$work/jmag_broken.csv"
run 0 predict data/machine_a "$work/jmag_broken.csv"
says '1 of 400 rows have a hole and are left out, first line 12, column 2 `theta_m\(deg\)`: found `x`'
run 3 predict data/machine_a "$work/jmag_broken.csv" --strict
says 'jmag_broken.csv:12: column 2 `theta_m\(deg\)`: found `x`'

# ---- Ansys Maxwell

write maxwell.csv 'NR == 1 { print "\"Nr []\",\"Time [ms]\",\"Moving1.Torque [mNewtonMeter]\",\"Moving1.Position [deg]\",\"Moving1.Speed [rpm]\",\"Current(PhaseA) [A]\",\"Current(PhaseB) [A]\",\"Current(PhaseC) [A]\"" }
    { print "4," 1000 * t "," 1000 * T "," deg(m) ",30," ia "," ib "," ic }'
same_model maxwell.csv
same_orders cogging maxwell.csv

# ---- SyR-e: electrical degrees; what its axes are is said

write syre.csv 'NR == 1 { print "th,Id,Iq,Fd,Fq,T" } { print deg(2 * m) "," id "," iq ",0.1,0.02," T }'
same_model syre.csv '`th` is read as the electrical angle, in deg' "\`Id\` is read as i_d as it stands; SyR-e's 'SR' axes" '`T` is read as the torque, in N\*m'
same_orders cogging syre.csv
sed '1s/th/theta/' "$work/syre.csv" >"$work/syre_theta.csv"
same_model syre_theta.csv '`theta` is read as the electrical angle, in deg'

# ---- motulator: theta_m and w_m are electrical there

write motulator.csv 'NR == 1 { print "t,i_sd,i_sq,tau_M,theta_m,w_m" } { print t "," id "," iq "," T "," wrapped(2 * m, 2 * pi) "," 2 * pi }'
same_model motulator.csv '`theta_m` is read as the electrical angle, in rad' '`w_m` is read as the electrical speed, divided by the pole pairs, in rad/s'
write simulink.csv 'NR == 1 { print "Time,i_a,i_b,i_c,Te,thetam,wm" } { print t "," ia "," ib "," ic "," T "," m "," pi }'
same_model simulink.csv '`wm` is read as the mechanical speed, in rad/s'

# ---- moteus and ODrive: turns

write moteus.csv 'NR == 1 { print "timestamp,mode,position,velocity,torque,q_current,d_current" } { print t ",10," turns(m) ",0.5," T "," iq "," id }'
same_model moteus.csv '`position` is read as the mechanical angle, in rev' '`timestamp` is read as the time, in s' '`torque` is a torque that the drive has computed from its current: it is not used'
check "moteus.csv: a residual of the drive's own torque" eval "! grep -q residual_Nm '$work/predicted.csv'"
write odrive.csv 'NR == 1 { print "time,axis0.pos_estimate,axis0.vel_estimate,axis0.motor.foc.Iq_measured,axis0.motor.foc.Id_measured" }
    { print t "," turns(m) ",0.5," iq "," id }'
same_model odrive.csv '`axis0.pos_estimate` is read as the mechanical angle, in turn' '`axis0.vel_estimate` is read as the mechanical speed, in turn/s'

# ---- LTspice and oscilloscopes: voltages of phases

write ltspice.txt 'NR == 1 { print "time\tV(a)\tV(b)\tV(c)\tI(Ra)" } { print t "\t" va "\t" vb "\t" vc "\t0" }'
same_orders back_emf ltspice.txt
write pico.csv 'NR == 1 { print "Time,Channel A,Channel B,Channel C"; print "(ms),(V),(mV),(V)"; print "" } { print 1000 * t "," va "," 1000 * vb "," vc }'
same_orders back_emf pico.csv '`Channel A` is read as the voltage of phase a, and those after it as b and c'
write keysight.csv 'NR == 1 { print "x-axis,1,2,3"; print "second,Volt,Volt,Volt" } { print t "," va "," vb "," vc }'
same_orders back_emf keysight.csv '`1` is read as the voltage of phase a'
write tektronix.csv 'NR == 1 { print "Model,MSO24"; print "Horizontal Units,s"; print "Sample Interval,0.02"; print "Vertical Units,V,V,V"; print ",,,"; print "Label,,,"
        print "TIME,CH1,CH2,CH3" } { print t "," va "," vb "," vc }'
same_orders back_emf tektronix.csv 'line 7 is the header' '`CH1` is read as the voltage of phase a, .*, in V'
write siglent.csv 'NR == 1 { print "Record Length,Analog:400"; print "Sample Interval,Analog:0.02"; print "Source,CH1,CH2,CH3"; print "Second,Volt,Volt,Volt" }
    { print t "," va "," vb "," vc }'
same_orders back_emf siglent.csv 'line 3 is the header'
write waveforms.csv 'NR == 1 { print "#Digilent WaveForms Oscilloscope Acquisition"; print "#Device Name: ADP3450"; print ""; print "Time (s),Channel 1 (V),Channel 2 (V),Channel 3 (V)" }
    { print t "," va "," vb "," vc }'
same_orders back_emf waveforms.csv '`Channel 1 \(V\)` is read as the voltage of phase a'

# ---- names with units in every way, decimal comma

write units.csv 'NR == 1 { print "Time (ms);theta_m / deg;speed [1/min];Ia[A];Ib, A;Ic_mA;Torque (N\302\267cm)" }
    { line = 1000 * t ";" deg(m) ";30;" ia ";" ib ";" 1000 * ic ";" 100 * T; gsub(/\./, ",", line); print line }'
same_model units.csv
same_orders cogging units.csv

# ---- what may be two things is refused, and the remedy named

write theta.csv 'NR == 1 { print "t,theta,iq" } { print t "," m "," iq }'
run 3 predict data/machine_a "$work/theta.csv"
says 'theta.csv:1: column 2 `theta`: found an angle that may be mechanical or electrical, expected theta_m or theta_e; rename'
write twice.csv 'NR == 1 { print "theta_m_deg,i_sq,i_q" } { print deg(m) "," iq "," iq }'
run 3 predict data/machine_a "$work/twice.csv"
says 'twice.csv:1: column [23] `i_s?q`: found `iq_A` a second time'
write rivals.csv 'NR == 1 { print "speed,torque"; print "theta_m,iq" } { print m "," iq }'
run 3 predict data/machine_a "$work/rivals.csv" # which of the two is the header?
says 'rivals.csv:1: found no angle of the rotor but `speed`, `torque`'

# ---- diagnose reads its list of such files

mkdir "$work/known" # the machine that these samples are of, so that nothing is to be searched for
printf 'name,value,unit\npole_pairs,2,1\n' >"$work/known/machine.csv"
printf 'order,amplitude_Nm_per_A,phase_rad\n1,0.133333333333,0\n' >"$work/known/back_emf.csv"
printf 'order,amplitude_Nm,phase_rad\n6,0.02,1.57079632679\n12,0.05,0.3\n' >"$work/known/cogging.csv"
printf 'file,role\ndyno.csv,fit\nmoteus.csv,fit\nsyre.csv,holdout\n' >"$work/list.csv"
"$hci_solve" diagnose "$work/known" --runs "$work/list.csv" -q -o "$work/diagnosed"
check "diagnose: exit code $?" [ $? -le 1 ]
check "diagnose: runs" [ "$(cut -d, -f1 "$work/diagnosed/errors.csv" | tr '\n' ' ')" = "file dyno.csv syre.csv " ]

finish
