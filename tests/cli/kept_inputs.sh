# Inputs of the tests whose results are kept, kept_all and what they share: sourced by cli_kept_*.sh, after common.sh.
cd "$source_dir" || exit 1
export OPENBLAS_NUM_THREADS=1
a=data/machine_a h=data/scenarios/02/harmonics.csv t=data/scenarios/02/target.csv
mkdir "$work/kept"

# Machine A with what a voltage limit needs, and recordings of one with an offset of phase a and cogging that it does not know.
cp -r $a "$work/m" && cd "$work" || exit 1
printf 'resistance,0.1,ohm,test\ninductance_d,0.5,mH,test\ninductance_q,0.5,mH,test\n' >>m/machine.csv
awk 'BEGIN {
    seed = 1; pi = atan2(0, -1); count = split("slow:60:2 back:-150:7 fast:400:5 held:90:4", run, " ")
    for (r = 1; r <= count; r++) {
        split(run[r], x, ":")
        print "time_s,theta_m_rad,speed_rad_per_s,ia_A,ib_A,ic_A,torque_Nm" >x[1] ".csv"
        for (k = 0; k < 150; k++) {
            angle = (x[2] < 0 ? -2 : 2) * pi * k / 100
            torque = 0.03 * sin(12 * angle + 0.4)
            for (p = 0; p < 3; p++) {
                i[p] = x[3] * sin(2 * angle - 2 * pi * p / 3)
                torque += 0.2 * i[p] * sin(2 * angle - 2 * pi * p / 3)
            }
            for (n = 0; n < 12; n++) { seed = 16807 * seed % 2147483647; torque += 0.01 * (seed / 2147483647 - 0.5) }
            printf "%.9f,%.9f,%g,%.9f,%.9f,%.9f,%.9f\n", angle / x[2], angle, x[2], i[0] + 0.3, i[1], i[2], torque >x[1] ".csv"
        }
    }
}' || exit 1
# Voltages of open terminals; the same machine with other faults: gain of phase b, an eccentric encoder, drag, a delayed angle.
awk 'BEGIN {
    seed = 3; pi = atan2(0, -1); print "time_s,theta_m_rad,va_V,vb_V,vc_V" >"open.csv"
    for (k = 0; k < 600; k++) {
        t = k * 1e-3; w = 50 + 10 * t; a = 50 * t + 5 * t * t; printf "%.9f,%.9f", t, a >"open.csv"
        for (p = 0; p < 3; p++) {
            e = 2 * a - 2 * pi * p / 3 + 0.1; noise = 0
            for (n = 0; n < 12; n++) { seed = 16807 * seed % 2147483647; noise += 0.01 * (seed / 2147483647 - 0.5) }
            printf ",%.9f", w * (0.2 * (1 + 0.01 * p) * sin(e) + 0.02 * sin(5 * e + 0.3) + 0.01 * sin(7 * e - 0.2)) + noise >"open.csv"
        }
        print "" >"open.csv"
    }
    count = split("slow:60:2 back:-150:7 fast:400:5 idle:200:0", run, " ")
    for (r = 1; r <= count; r++) {
        split(run[r], x, ":"); file = "worn_" x[1] ".csv"
        print "time_s,theta_m_rad,speed_rad_per_s,id_A,iq_A,torque_Nm" >file
        for (k = 0; k < 200; k++) {
            angle = (x[2] < 0 ? -2 : 2) * pi * k / 100
            torque = -0.02 * (x[2] < 0 ? -1 : 1) - 0.0003 * x[2] + 0.04 * sin(6 * angle) + 0.3 * x[3] * (1 + 0.02 * sin(12 * angle)) - 0.002 * x[3] * x[3] * x[3]
            for (n = 0; n < 12; n++) { seed = 16807 * seed % 2147483647; torque += 0.01 * (seed / 2147483647 - 0.5) }
            printf "%.9f,%.9f,%g,%.9f,%.9f,%.9f\n", angle / x[2], angle + 0.01 * sin(angle) + 2e-5 * x[2], x[2], 0, x[3], torque >file
        }
    }
}' || exit 1
printf 'file,role\nworn_slow.csv,fit\nworn_back.csv,fit\nworn_fast.csv,fit\nworn_idle.csv,fit\n' >worn.csv
mkdir simple && printf 'name,value,unit,source\npole_pairs,2,1,test\n' >simple/machine.csv
printf 'order,amplitude_Nm_per_A,phase_rad\n1,0.2,0\n' >simple/back_emf.csv
printf 'file,role\nslow.csv,fit\nback.csv,fit\nfast.csv,fit\nheld.csv,holdout\n' >runs.csv
printf 'motor,batch,date,machine,runs\n' >motors.csv
for k in 1 2 3 4 5 6; do
    printf 'file,role\n%s.csv,fit\nback.csv,fit\n' "$(echo slow held fast held slow fast | cut -d' ' -f$k)" >"runs$k.csv"
    echo "m$k,b$((k % 2)),2025-01-0$k,simple,runs$k.csv"
done >>motors.csv
ln -s "$source_dir/data" data || exit 1
sed 's/^duration,[^,]*/duration,0.3/; s/^settle,[^,]*/settle,0.1/' data/drive/filho_strategy_2.csv >filho.csv
head -n 7 $h >few.csv

# kept NAME CODE WORD...: the results of a command go where they are compared, and what it says as JSON where that is none of its files.
kept() {
    name=$1 code=$2
    shift 2
    run "$code" "$@" -q --json -o "kept/$name"
    [ -e "kept/$name/summary.json" ] || cp "$work/stdout" "kept/$name.said.json"
}

# Words without numbers, whose last digit may be rounded otherwise; those of a page are without tags, digests and versions too.
no_numbers() {
    sed 's/[-+]\{0,1\}[0-9][0-9.]*\(e[-+][0-9]*\)\{0,1\}/0/g'
}
page_words() { # PAGE
    sed "s/<[^>]*>/ /g; s|$work|.|g; s/hci-solve [0-9.]*//g; s/[0-9a-f]\{8,\}//g" "$1" | grep -v -i 'crc\|version' | no_numbers
}

# kept_all NAME: all of it beside tests/files/kept/NAME.txt; --renew: writes that anew.
kept_all() {
    shown="tests/cli/kept.py"
    check "results differ from tests/files/kept/$1.txt; where that is meant: the command of this test with --renew behind it" \
        python3 "$source_dir/tests/cli/kept.py" kept "$source_dir/tests/files/kept/$1.txt" ${2:+"$2"}
}
