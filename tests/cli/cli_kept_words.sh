#!/bin/sh
# What commands say of recordings whose columns are hardly known, and what pages of results say, is that in tests/files/kept/words.txt: as a CRC of the words of each. After a change of words that is meant: --renew, and look at what is said.
#   cli_kept_words.sh SOURCE_DIR BUILD_DIR HCI_SOLVE [--renew]
. "$1/tests/support/common.sh"
use_plain_build
. "$source_dir/tests/cli/kept_inputs.sh"
cd "$work" || exit 1

# said NAME WORD...: what a command says goes where it is compared.
said() {
    name=$1
    shift
    "$hci_solve" "$@" --color never >stdout 2>stderr </dev/null
    { echo "ends with $?" && no_numbers <stdout && cat stderr; } | sed "s|$work|.|g" >"kept/$name.txt"
}
# log HEADER CELLS: rows of a shaft at 31 rad/s, as awk prints them of k, t, m (angle, one turn), w, q and T; read by predict, and by check that can do without an angle.
logs=0
log() {
    logs=$((logs + 1))
    awk -v header="$1" 'BEGIN { pi = atan2(0, -1); print header; for (k = 0; k < 240; k++) { t = k * 0.004; w = 31; m = w * t - 2 * pi * int(w * t / 2 / pi); q = 3 + sin(5 * t); T = 0.3 * q; print '"$2"' } }' >"log_$logs.csv"
    said "log_$logs.predict" predict simple "log_$logs.csv"
    said "log_$logs.check" check simple "log_$logs.csv"
}
c='","'
# Angles and counts, with and without units, beside another one, a current and a gear.
log time_s,encoder_angle,iq_A,torque_Nm "t $c m $c q $c T"
log 'time_s,Winkel [°],iq_A,torque_Nm' "t $c m * 57.29578 $c q $c T"
log 'time_s,rotor_lage [gon],iq_A,torque_Nm' "t $c m * 63.662 $c q $c T"
log time_s,theta_m,iq_A,torque_Nm "t $c m * 57.29578 $c q $c T"
log time_s,theta_e,iq_A,torque_Nm "t $c int(m * 57.29578) $c q $c T"
log time_s,theta_m,iq_A,torque_Nm "t $c int(m * 57.29578 / 3) * 3 $c q $c T"
log time_s,enc_count,iq_A,torque_Nm "t $c int(m / 6.2832 * 4096) $c q $c T"
log time_s,speed_rad_per_s,enc_count,iq_A,torque_Nm "t $c w $c int(m / 6.2832 * 4000) $c q $c T"
log time_s,speed_rad_per_s,enc_count,iq_A,torque_Nm "t $c w $c int(w * t / 6.2832 * 1000) $c q $c T"
log time_s,speed_rad_per_s,resolver,iq_A,torque_Nm "t $c w $c 100 + int(w * t / 6.2832 * 777) $c q $c T"
log time_s,position_raw,iq_A,torque_Nm "t $c int(m / 6.2832 * 65536) $c q $c T"
log time_s,Rotor_Angle,gear_angle,iq_A,torque_Nm "t $c m $c 5 * m $c q $c T"
log time_s,rotor_current,rotor_rpm,iq_A,torque_Nm "t $c q $c w $c q $c T"
log iq_A,torque_Nm "q $c T"
log iq_A,angolo,torque_Nm "q $c m $c T"
log time_s,iq_A "t $c q"
log sample,foo,bar "k $c q $c T"
# Times.
log 'unix,theta_m_rad,iq_A,torque_Nm' "1.7e9 + k $c m $c q $c T"
log 'ms,theta_m_rad,iq_A,torque_Nm' "1000 * t $c m $c q $c T"
log 'us,theta_m_rad,iq_A,torque_Nm' "1e6 * t $c m $c q $c T"
log 'micros_since,theta_m_rad,iq_A,torque_Nm' "1e6 * t $c m $c q $c T"
log 'msec,theta_m_rad,iq_A,torque_Nm' "k % 2 ? k : k + 3 $c m $c q $c T"
log 'tick10ms,theta_m_rad,iq_A,torque_Nm' "k $c m $c q $c T"
log 'tick_50us,theta_m_rad,iq_A,torque_Nm' "k $c m $c q $c T"
log 'ticks,theta_m_rad,iq_A,torque_Nm' "k $c m $c q $c T"
log 'Uhr_x,theta_m_rad,iq_A,torque_Nm' "t $c m $c q $c T"
log 'stamp_a [ms],theta_m_rad,iq_A,torque_Nm' "1000 * t $c m $c q $c T"
log 'elapsed,theta_m_rad,iq_A,torque_Nm' "5 $c m $c q $c T"
# Torques, forces, currents and speeds.
log time_s,theta_m_rad,iq_A,force "t $c m $c q $c T"
log time_s,theta_m_rad,iq_A,load_cell_g "t $c m $c q $c T * 100"
log 'time_s,theta_m_rad,iq_A,Moment_ist [%]' "t $c m $c q $c T * 10"
log time_s,theta_m_rad,iq_A,trq_meas "t $c m $c q $c T"
log 'time_s,theta_m_rad,iq_A,shaft moment [mNm]' "t $c m $c q $c T * 1000"
log time_s,theta_m_rad,Iq_int16,torque_Nm "t $c m $c int(q * 1000) $c T"
log time_s,theta_m_rad,motor_current,torque_Nm "t $c m $c q $c T"
log 'time_s,theta_m_rad,I_d_ist [A],I_q_ist [A],torque_Nm' "t $c m $c 0 $c q $c T"
log time_s,theta_m_rad,n_mot,iq_A,torque_Nm "t $c m $c w * 9.5493 $c q $c T"
log 'time_s,theta_m_rad,Drehzahl_x [1/min],iq_A,torque_Nm' "t $c m $c w * 9.5493 $c q $c T"
log time_s,theta_m_rad,iq_A,torque_est "t $c m $c q $c T"
log time_s,theta_m_rad,iq_A,torque_Nm,torque_computed "t $c m $c q $c T $c T"
# Voltages; two of three phases; lines.
log time_s,va_V,vb_V,vc_V "t $c 3 * sin(2 * w * t) $c 3 * sin(2 * w * t - 2.0944) $c 3 * sin(2 * w * t + 2.0944)"
log 'time_s,vab_V,vbc_V,theta_m_rad,iq_A' "t $c 3 * sin(2 * w * t) $c 3 * sin(2 * w * t - 2.0944) $c m $c q"
log 'time_s,Kanal 1 [V],Kanal 2 [V]' "t $c 3 * sin(2 * w * t) $c 3 * sin(2 * w * t - 2.0944)"
log time_s,theta_m_rad,ia_A,ib_A,torque_Nm "t $c m $c q * sin(2 * m) $c q * sin(2 * m - 2.0944) $c T"
log time_s,theta_m_rad,ia_A,torque_Nm "t $c m $c q * sin(2 * m) $c T"
# What is none.
log order,amplitude_Nm "k + 1 $c q"
log file,role "\"a.csv,fit\""
log name,column "\"iq,x\""
printf 'time_s,theta_m_rad,iq_A,torque_Nm\n' >head.csv && said head predict simple head.csv
{ printf 'logger 5\nof a bench\n' && cat log_1.csv; } >lines.csv && said lines predict simple lines.csv
said encoder harmonics log_8.csv --quantity cogging --pole-pairs 2 --torque-constant 0.3

# Pages as words. page NAME WORD...: what a command says, and report.html without its tags.
page() {
    name=$1
    shift
    said "$name" "$@" -o "out/$name"
    page_words "out/$name/report.html" >"kept/$name.page.txt"
    check "$name has a page: $(cat stderr)" [ -s "kept/$name.page.txt" ]
}
mkdir out
page auto solve $a --target $t --auto --report
page pointwise solve $a --target $t --method pointwise --report
page limited solve m --target $t --harmonics $h --limit-current 12 --limit-voltage 40 --speed 1500 --report
page driven solve $a --target $t --auto --drive data/drive/machine_a_10kHz.csv --speed 600 --report
page few solve data/machine_b --target data/scenarios/12/target.csv --auto 9 --max-loss 1.5 --report
page held solve $a --target $t --auto --limit-current 17 --limit-rms 10 --report
mkdir single && sed 's/^pole_pairs,2/pole_pairs,1/' simple/machine.csv >single/machine.csv && cp simple/back_emf.csv single
said single check single slow.csv back.csv fast.csv
said verbose check simple slow.csv fast.csv --verbose
said check check simple slow.csv back.csv fast.csv
said wrong check $a slow.csv back.csv
page trade sweep $a --trade-off --torque 1 --currents 8 --harmonics few.csv --report
page envelope sweep $a --envelope --speeds 0 --ripple 40 --limit-current 20 --harmonics few.csv --report
page tune tune slow.csv fast.csv back.csv --pole-pairs 2 --torque-constant 0.3
kept_all words "${4-}"
finish
