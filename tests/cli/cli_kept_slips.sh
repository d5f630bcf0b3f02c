#!/bin/sh
# What `check` finds of conventions that a machine or its recordings break, one after another, is that in tests/files/kept/slips.txt, number by number: the
# probabilities of the slips and each comparison. After a change that is meant: --renew, and look at the differences.
#   cli_kept_slips.sh SOURCE_DIR BUILD_DIR HCI_SOLVE [--renew]
. "$1/tests/support/common.sh"
use_plain_build
cd "$work" || exit 1

# log NAME SPEED ID IQ NOISE: machine B of a bench, p = 3, 0.24 V·s, R = 0.6 ohm, L_d = 3 mH, L_q = 5 mH, cogging of order 6 and a speed that swings.
log() {
    awk -v w="$2" -v d="$3" -v q="$4" -v seed="$5" 'function noise(   n, sum) { for (n = 0; n < 12; n++) { seed = 16807 * seed % 2147483647; sum += seed / 2147483647 - 0.5 } return sum }
        function phase(p, d, q, e) { return -d * cos(e - 2 * pi * p / 3) + q * sin(e - 2 * pi * p / 3) }
        BEGIN { pi = atan2(0, -1); a = 0.7; dt = 4e-4; print "time_s,theta_m_rad,speed_rad_per_s,ia_A,ib_A,ic_A,va_V,vb_V,vc_V,torque_Nm"
        for (k = 0; k < 500; k++) {
            v = w * (1 + 0.03 * sin(2 * a)); e = 3 * a; u = 3 * v
            T = 1.5 * 0.24 * q - 4.5 * 0.002 * d * q + 0.04 * sin(18 * a + 0.3) + 0.015 * cos(36 * a) + 0.01 * q * sin(18 * a) - (v < 0 ? -1 : 1) * 0.03
            vd = 0.6 * d - u * 0.005 * q; vq = 0.6 * q + u * (0.003 * d + 0.08)
            printf "%.6f,%.7f,%.6f", k * dt, a, v
            for (p = 0; p < 3; p++) printf ",%.6f", phase(p, d, q, e) + 0.01 * noise()
            for (p = 0; p < 3; p++) printf ",%.6f", phase(p, vd, vq, e) + 0.02 * noise()
            printf ",%.6f\n", T + 0.003 * noise()
            a += v * dt } }' >"$1.csv"
}
log idle 70 0 0 5
log load 90 -2 6 7
log back -60 1 4 11
log more 40 -4 -5 13

# machine NAME: as it is; bench NAME SED: its recordings with a slip of their own.
machine() {
    mkdir "$1"
    printf 'name,value,unit,source\npole_pairs,3,1,test\nresistance,0.6,ohm,test\ninductance_d,3,mH,test\ninductance_q,5,mH,test\nrated_current,6,A,test\nrated_torque,2.2,Nm,test\nslots,18,1,test\n' >"$1/machine.csv"
    printf 'order,amplitude_Nm_per_A,phase_rad\n1,0.24,0\n5,0.004,0.2\n7,0.002,0.1\n' >"$1/back_emf.csv"
    printf 'order,amplitude_Nm,phase_rad\n6,0.04,0.3\n12,0.015,1.5707963\n' >"$1/cogging.csv"
}
# checked NAME FILE...
checked() {
    name=$1
    shift
    "$hci_solve" check "${folder:-right}" "$@" -q -o "kept/$name" >stdout 2>stderr
    check "$name is checked: $(cat stderr)" [ -s "kept/$name/summary.json" ]
}
# changed NAME AWK: all four recordings changed, and checked.
changed() {
    for f in idle load back more; do awk -F, -v OFS=, "NR > 1 { $2 } 1" "$f.csv" >"$f.$1.csv"; done
    checked "$1" "idle.$1.csv" "load.$1.csv" "back.$1.csv" "more.$1.csv"
}
mkdir kept
machine right
checked right idle.csv load.csv back.csv more.csv
checked alone
checked one load.csv
changed sign '$10 = -$10'
changed milli '$10 *= 1000'
changed swapped 'x = $5; $5 = $6; $6 = x'
changed swapped_all 'x = $5; $5 = $6; $6 = x; x = $8; $8 = $9; $9 = x'
changed rms '$4 /= 1.41421356; $5 /= 1.41421356; $6 /= 1.41421356'
changed turned '$2 = -$2'
changed degrees '$2 *= 57.29577951'
changed ahead '$2 += 0.5235987756'
changed electrical '$2 *= 3'
changed rpm '$3 *= 9.549296586'
changed other_way '$3 = -$3'
changed late '$2 -= 0.002 * $3'
changed ms '$1 *= 1000'
changed inch '$10 *= 8.850746'
changed negative '$4 = -$4; $5 = -$5; $6 = -$6'
changed offset '$4 += 0.5; $10 += 0.2'
changed voltages '$7 *= 1.732; $8 *= 1.732; $9 *= 1.732'

changed off '$2 += 0.18'
changed geared '$2 *= 5'
changed slower '$2 /= 4'
changed gon '$2 *= 63.6619772'
changed milliamperes '$4 *= 1000; $5 *= 1000; $6 *= 1000'
changed rotated 'x = $4; $4 = $5; $5 = $6; $6 = x'
changed clamps 'x = $4; $4 = $5; $5 = x'
changed probes 'x = $7; $7 = $9; $9 = x'
changed both_ways '$2 = -$2; $3 = -$3'
changed electrical_speed '$3 *= 3'
changed unsigned '$3 = $3 < 0 ? -$3 : $3'
changed minutes '$1 /= 60'
changed pound_feet '$10 *= 0.7375621'
for f in idle load back more; do # currents of the rotor frame, and a row of units
    awk -F, -v OFS=, 'NR == 1 { print "time,theta_m,speed,id,iq,torque"; print "s,rad,rad/s,A,A,mNm"; next }
        { e = 3 * $2; r = 2.0943951024; s = sin(e) * $4 + sin(e - r) * $5 + sin(e + r) * $6; c = cos(e) * $4 + cos(e - r) * $5 + cos(e + r) * $6
          print $1, $2, $3, -c / 1.5, s / 1.5, $10 }' "$f.csv" >"$f.dq.csv"
    awk -F, -v OFS=, 'NR == 2 { $6 = "Nm"; $2 = "deg" } 1' "$f.dq.csv" >"$f.dq_deg.csv"
    awk -F, -v OFS=, 'NR == 2 { $6 = "Nm" } NR > 2 { $4 = -$4; $5 = -$5 } 1' "$f.dq.csv" >"$f.dq_minus.csv"
    awk -F, -v OFS=, 'NR == 2 { $6 = "Nm" } NR > 2 { $4 /= 1.2247449; $5 /= 1.2247449 } 1' "$f.dq.csv" >"$f.dq_power.csv"
    awk -F, -v OFS=, 'NR == 2 { $6 = "Nm" } NR > 2 { $4 *= 1000; $5 *= 1000 } 1' "$f.dq.csv" >"$f.dq_milli.csv"
done
for name in dq dq_deg dq_minus dq_power dq_milli; do checked $name "idle.$name.csv" "load.$name.csv" "back.$name.csv" "more.$name.csv"; done

# folder NAME FILE SED: a slip of the machine.
slip() {
    machine "$1"
    sed -i "$3" "$1/$2"
    folder=$1
    checked "m_$1" idle.csv load.csv back.csv more.csv
    folder=
}
slip poles machine.csv 's/^pole_pairs,3/pole_pairs,6/'
slip line back_emf.csv 's/0.24,/0.4157,/'
slip rms back_emf.csv 's/0.24,/0.1697,/'
slip peaks back_emf.csv 's/0.24,/0.48,/'
slip minus back_emf.csv 's/0.24,/-0.24,/'
slip cosine back_emf.csv 's/0.24,0/0.24,1.5708/'
slip per_turn back_emf.csv 's/^1,/3,/; s/^5,/15,/; s/^7,/21,/'
slip resistance machine.csv 's/,0.6,/,1.2,/'
slip inductance machine.csv 's/_d,3,/_d,5,/; s/_q,5,/_q,3,/'
slip rated machine.csv 's/current,6,/current,8.485,/'
slip torque machine.csv 's/torque,2.2,/torque,22,/'
slip cogging cogging.csv 's/^6,0.04,/6,0.08,/; s/^12,0.015,/12,0.03,/'
slip cogging_turn cogging.csv 's/^6,/18,/; s/^12,/36,/'
slip cogging_minus cogging.csv 's/^6,0.04/6,-0.04/; s/^12,0.015/12,-0.015/'
slip cogging_degrees cogging.csv 's/0.3$/17.2/; s/1.5707963/90/'
# What was changed above is what is named, at its place, with what should stand there; and nothing where it may be so:
# NAME VERDICT [SLIP FILE:LINE COLUMN | SHOULD_BE | WORDS].
python3 -c 'import json, pathlib
for path in sorted(pathlib.Path("kept").glob("*/summary.json")):
    s = json.loads(path.read_text())
    print(path.parent.name, s["verdict"], *("%s %s:%d %s | %s | %s" % (f["slip"], f["file"], f["line"], f["column"], f["should_be"], f["words"]) for f in s["findings"][:1]))' >said.txt
shown='hci-solve check, of each change'
while read -r words; do
    check "not $words, but $(grep "^${words%% *} " said.txt)" grep -Fxq "$words" said.txt
done <<'EOF'
ahead slips run_angle_zero_q_axis idle.ahead.csv:1 theta_m_rad | the electrical angle - pi/2 | the recordings count the angle from the trough of the back-EMF (e_a = -cos)
alone consistent
both_ways slips phases_swapped idle.both_ways.csv:1 ia_A | b and c the other way round: --column 'ib=ic_A' --column 'ic=ib_A' | phases b and c of the recordings are swapped, or another two with another zero of the angle, or angle and speed are both counted backward
clamps slips currents_swapped idle.clamps.csv:1 ia_A | a and b of the currents the other way round: --column 'ia=ib_A' --column 'ib=ia_A' | phases a and b of the currents are swapped, and those of the voltages are not
degrees slips theta_degrees_for_radians idle.degrees.csv:1 theta_m_rad | in degrees: --column 'theta_m_deg=theta_m_rad' | the angle of the recordings is in degrees
dq_deg slips theta_radians_for_degrees idle.dq_deg.csv:1 theta_m | rad in line 2, the row of units | the angle of the recordings was read as degrees, and is in radians
dq_milli slips current_milliampere idle.dq_milli.csv:1 iq | mA in line 2, the row of units | the currents are in mA
dq_minus slips current_sign idle.dq_minus.csv:1 iq | every current with the opposite sign | the currents are counted out of the machine
electrical slips theta_electrical_for_mechanical idle.electrical.csv:1 theta_m_rad | theta_e: --column 'theta_e=theta_m_rad' | the angle of the recordings is electrical, not mechanical, or of a shaft that a gear turns 3 times as fast
electrical_speed slips speed_electrical idle.electrical_speed.csv:1 speed_rad_per_s | the speed divided by pole_pairs: --column 'speed_e=speed_rad_per_s' | the speed is electrical, not mechanical
geared slips angle_geared idle.geared.csv:1 theta_m_rad | the angle of the rotor | the angle of the recordings is of a shaft behind a gear of 5: the rotor turns 0.2 times while it turns once
inch slips torque_pound_inch idle.inch.csv:1 torque_Nm | torque_lbfin: --column 'torque_lbfin=torque_Nm' | the torque is in lbf·in
m_cogging_degrees slips phases_in_degrees cogging_degrees/cogging.csv:2 phase_rad | phase_deg | the phases of both tables are in degrees
m_cogging_turn slips cogging_orders_mechanical cogging_turn/cogging.csv:2 order | 6: every order divided by pole_pairs | the orders of cogging.csv are per mechanical turn
m_cosine slips angle_zero_q_axis cosine/back_emf.csv:2 phase_rad | 3.67321e-06: in every table, phase - order x pi/2 | the tables count the angle from the crest of the back-EMF (e_a = cos), not from its rising zero crossing
m_line slips emf_line line/back_emf.csv:2 amplitude_Nm_per_A | 0.240005 | the back-EMF is given line to line, not line to star point
m_per_turn slips emf_orders_mechanical per_turn/back_emf.csv:2 order | 1: every order divided by pole_pairs | the orders of back_emf.csv are per mechanical turn
m_poles slips poles_for_pole_pairs poles/machine.csv:2 value | 3 | pole_pairs is the number of poles
m_resistance ambiguous resistance_line resistance/machine.csv:3 value | 0.6 | resistance is between two terminals, not of a phase
m_rms slips emf_rms rms/back_emf.csv:2 amplitude_Nm_per_A | 0.239992 | the back-EMF is given as rms of a phase, not as peak
milli slips torque_millinewton idle.milli.csv:1 torque_Nm | torque_mNm: --column 'torque_mNm=torque_Nm' | the torque is in mN·m
milliamperes slips current_milliampere idle.milliamperes.csv:1 ia_A | in mA: --column 'ia_mA=ia_A', and so of each current | the currents are in mA
ms slips time_milliseconds idle.ms.csv:1 time_s | time_ms: --column 'time_ms=time_s' | the time is in milliseconds
negative slips current_sign idle.negative.csv:1 ia_A | with the opposite sign: --column 'ia=-ia_A', and so of each current | the currents are counted out of the machine
off slips run_angle_offset idle.off.csv:1 theta_m_rad | the electrical angle - 30.9 degrees | the electrical zero of the angle in the recordings is 30.9 ± 0.1 degrees off: give --angle-offset -30.9
one consistent
probes slips voltages_swapped idle.probes.csv:1 va_V | a and c of the voltages the other way round | phases a and c of the voltages are swapped, and those of the currents are not
right consistent
rms slips current_rms idle.rms.csv:1 ia_A | every current times sqrt(2): --column 'ia_Arms=ia_A', and so of each | the phase currents are scaled to rms values
rpm slips speed_rpm_for_rad_per_s idle.rpm.csv:1 speed_rad_per_s | speed_rpm: --column 'speed_rpm=speed_rad_per_s' | the speed is in rpm
sign slips torque_sign idle.sign.csv:1 torque_Nm | with the opposite sign: --column 'torque=-torque_Nm' | the torque is that of a generator: positive against the rotation
swapped slips currents_swapped idle.swapped.csv:1 ia_A | b and c of the currents the other way round: --column 'ib=ic_A' --column 'ic=ib_A' | phases b and c of the currents are swapped, and those of the voltages are not
swapped_all slips phases_swapped idle.swapped_all.csv:1 ia_A | b and c the other way round: --column 'ib=ic_A' --column 'ic=ib_A' | phases b and c of the recordings are swapped, or another two with another zero of the angle, or angle and speed are both counted backward
turned slips direction_reversed idle.turned.csv:1 theta_m_rad | the angle with the opposite sign | the angle of the recordings is counted backward
unsigned slips speed_unsigned idle.unsigned.csv:1 speed_rad_per_s | the speed with the sign of the angle's change | the speed has no sign: it is positive backward, too
voltages slips voltage_line idle.voltages.csv:1 va_V | vab_V, vbc_V, vca_V | the voltages are line to line: va holds v_ab, vb v_bc, vc v_ca
EOF
kept_by="$source_dir/tests/cli/kept.py"
shown=$kept_by
check 'results differ from tests/files/kept/slips.txt; where that is meant: the command of this test with --renew behind it' \
    python3 "$kept_by" kept "$source_dir/tests/files/kept/slips.txt" ${4:+"$4"}
finish
