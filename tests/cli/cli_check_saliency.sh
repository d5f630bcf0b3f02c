#!/bin/sh
# Torques of a reluctance machine with magnets on its line of the most torque per ampere, L_d and L_q not declared: an effect explains them, and no
# convention is accused. One that is broken is. tune declares both inductances.
#   cli_check_saliency.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
use_plain_build
cd "$work" || exit 1

# 2 pole pairs, 0.15 Wb, L_d 10 mH, L_q 50 mH at no current and 33 mH at 15 A; 36 slots, friction 0.12 N·m
load() { # FILE I_d_A I_q_A SPEED_rpm SEED [TIMES_CURRENT [TIMES_TORQUE]]
    awk -v d="$2" -v q="$3" -v rpm="$4" -v seed="$5" -v read="${6:-1}" -v shown="${7:-1}" 'BEGIN { srand(seed); turn = 6.283185307179586; w = rpm * turn / 60
        print "time_s,theta_m_rad,ia_A,ib_A,ic_A,torque_Nm"
        linked = 0.004 * q + 0.55 * (q / 12) / sqrt(1 + q * q / 144)
        for (k = 0; k < 2400; ++k) { x = 0.3 + (w > 0 ? 1 : -1) * 3 * turn * k / 2400; a = 2 * x
            T = 3 * ((0.15 + 0.01 * d) * q - linked * d) - (w > 0 ? 0.12 : -0.12) + 0.05 * sin(36 * x + 0.4) + 0.01 * 0.45 * q * sin(6 * a)
            row = sprintf("%.6f,%.6f", (x - 0.3) / w, x)
            for (s = 0; s < 3; ++s) row = row sprintf(",%.4f", read * (q * sin(a - s * turn / 3) - d * cos(a - s * turn / 3)) + 0.02 * (rand() - 0.5))
            print row sprintf(",%.5f", shown * T + 0.02 * (rand() - 0.5)) } }' >"$1"
}
loads() { # [TIMES_CURRENT [TIMES_TORQUE]]
    load idle.csv 0 0 60 1 "$@"
    load idle_back.csv 0 0 -60 2 "$@"
    load light.csv -3.5 4.9 60 3 "$@"
    load half.csv -6.2 7.9 60 4 "$@"
    load full.csv -13.2 15 60 5 "$@"
    load across.csv 0 10 60 6 "$@"
}
says_once() { # PATTERN
    check "not once: $1" [ "$(tr '\n' ' ' <"$work/stdout" | tr -s ' ' | grep -cE "$1")" -eq 1 ]
}
sheet='--pole-pairs 2 --slots 36 --resistance 0.5 --rated-current 20'
line='idle.csv idle_back.csv light.csv half.csv full.csv'
run 0 init unsaid $sheet --flux 0.15 -o unsaid
loads

# ---- on one line of currents: no slip, but the saliency, and what is not told from it

for logs in "$line" "idle.csv idle_back.csv half.csv full.csv" "idle.csv light.csv full.csv" "idle.csv full.csv"; do
    run 0 check unsaid $logs
    says '^consistent'
    check "$logs: a slip is possible: $(grep '^  possible' "$work/stdout")" [ "$(grep -c '^  possible' "$work/stdout")" -eq 0 ]
    says_once 'saliency a reluctance torque that no inductance of the machine declares is in the torques, as of L_q - L_d = 0\.0[234][0-9]* H .*, or another scale of back-EMF, currents or torque \([0-9]+ % of it are left open\): a load at another i_d, best 0, '
done
run 0 check unsaid $line --json
check "no saliency in the summary" grep -qE '"saliency_H":[[:space:]]*0\.0(3[5-9]|4[0-4])' "$work/stdout"

# ---- a load at another i_d tells it; of a salient machine that declares its inductances, or none that is salient, nothing is said

run 0 check unsaid $line across.csv
says '^consistent'
says_once 'saliency a reluctance torque .* as of L_q - L_d = 0\.0(3[5-9]|4[0-4]?)[0-9]* H .*; beside it the torque per ampere is that of the tables within [0-9.]+ %'
run 0 init said $sheet --flux 0.15 --inductance-d 0.01 --inductance-q 0.05 -o said
run 0 check said $line across.csv
says '^consistent'
check "a saliency that is declared is not" [ "$(grep -c '^  saliency' "$work/stdout")" -eq 0 ]
run 0 check unsaid idle.csv idle_back.csv across.csv
check "a saliency without i_d" [ "$(grep -c '^  saliency' "$work/stdout")" -eq 0 ]

# ---- what is read wrongly is accused all the same where a load at i_d = 0 tells it, with a saliency that is declared and with one that is not

loads 0.7071
for machine in unsaid said; do
    run 1 check $machine $line across.csv
    says 'current_rms'
done
loads 1 -1
for machine in unsaid said; do
    run 1 check $machine $line across.csv
    says '(torque|current)_sign|run_angle_zero_d_axis'
done

# ---- tune goes on, and declares what it is given

loads
tune="tune $line --torque 8"
run 1 $tune $sheet --flux 0.15 -o tuned
check "a convention is broken: $(head -n 1 "$work/stdout")" [ "$(grep -c 'convention is broken' "$work/stdout")" -eq 0 ]
says_once 'a reluctance torque that no inductance of the machine declares .* --inductance-d and --inductance-q declare it'
whatever=$("$hci_solve" $tune $sheet --flux 0.15 --inductance-d 0.01 --inductance-q 0.05 -o salient 2>&1)
check "no reluctance torque is declared" grep -q '^inductance_q,0.05,H' salient/machine/machine.csv
check "no inductance.csv" [ -s salient/machine/inductance.csv ]
check "the commands are without it" grep -q 'init machine .*--inductance-d 0.01 --inductance-q 0.05' salient/commands.sh
check "a declared saliency is not declared" [ "$(echo "$whatever" | grep -c 'does not declare')" -eq 0 ]
run 2 $tune $sheet --flux 0.15 --inductance-d 10mH --inductance-q 0.05 -o unit
check "not said how it is written" grep -q 'write --inductance-d 0.01' "$work/stderr"
run 2 $tune $sheet --flux 0.15 --inductance-q 0.05 -o alone
check "one without the other" grep -q 'without --inductance-d' "$work/stderr"

# ---- an eccentric rotor: once a turn, which turns its sign with i_d, is no zero that has moved

eccentric() { # FILE I_d_A I_q_A
    awk -v d="$2" -v q="$3" 'BEGIN { srand(q - d); turn = 6.283185307179586
        print "time_s,theta_m_rad,ia_A,ib_A,ic_A,torque_Nm"
        for (k = 0; k < 3000; ++k) { x = 3 * turn * k / 3000; a = 3 * x
            T = 4.5 * (0.18 * q - 0.0053 * d * q) + 0.006 * (q + 2 * d) * sin(x + 0.6) + 0.02 * sin(18 * a)
            row = sprintf("%.6f,%.6f", x / 3.14, x)
            for (s = 0; s < 3; ++s) row = row sprintf(",%.4f", q * sin(a - s * turn / 3) - d * cos(a - s * turn / 3) + 0.02 * (rand() - 0.5))
            print row sprintf(",%.5f", T + 0.02 * (rand() - 0.5)) } }' >"$1"
}
eccentric ecc7.csv 0 7; eccentric ecc14.csv 0 14; eccentric ecc20.csv 0 20; eccentric ecc_d.csv -14 14
mkdir motor3
printf "name,value,unit\npole_pairs,3,1\nslots,36,1\nrated_current,20,A\nresistance,0.9,ohm\ninductance_d,0.005,H\ninductance_q,0.0103,H\n" >motor3/machine.csv
printf 'order,amplitude_Nm_per_A,phase_rad\n1,0.54,0\n' >motor3/back_emf.csv
run 0 check motor3 ecc7.csv ecc14.csv ecc20.csv ecc_d.csv
says '^consistent: '

finish
