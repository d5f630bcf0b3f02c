#!/bin/sh
# What `tune` says to call with what is recorded next does so when it is typed: the same options, quotes and all.
#   cli_tune_go_on.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
cd "$work" || exit 1

# Two constant currents of machine A with a torque sensor; names of columns with blanks and an apostrophe.
log() { # FILE CURRENT
    awk -v i="$2" -v seed="$3" 'BEGIN { srand(seed); print "Rotor mech [deg],Iq shaft'"'"'s [A],Drehm [Nm]"
        for (k = 0; k < 2000; ++k) { x = k * 0.36 * 3.14159265358979 / 180
            printf "%.3f,%.3f,%.5f\n", k * 0.36, i, 0.2 * i + 0.03 * sin(12 * x) + 0.004 * i * sin(12 * x + 1) + 0.003 * (rand() - 0.5) } }' >"$1"
}
log one.csv 4 1
log 'two b.csv' 8 2
log three.csv 6 3
any() { said=0; "$hci_solve" "$@" >"$work/stdout" 2>"$work/stderr" || said=$?; [ "$said" -le 1 ] || fail "exit code $said: $(cat "$work/stderr")"; }
any tune one.csv 'two b.csv' --pole-pairs 2 --torque-constant 0.2 --slots 12 --rated-current 8 \
    --column "iq=Iq shaft's [A]" --column 'theta_m=Rotor mech [deg]' --column 'torque=Drehm [Nm]' -o out
grep '^    hci-solve tune ' "$work/stdout" >line || fail "no call to go on with"
check "its words" grep -qF "tune one.csv 'two b.csv' NEW.csv --pole-pairs 2 --torque-constant 0.2 --slots 12 --rated-current 8 --out out" line
cp three.csv NEW.csv
sed "s|^ *hci-solve|\"$hci_solve\"|" line >line.sh
said=0
sh line.sh >"$work/stdout" 2>"$work/stderr" || said=$?
check "the call as it stands: $said" [ "$said" -le 1 ]
check "three logs are read" [ "$(grep -c '^  .*csv: 2000 samples' "$work/stdout")" = 3 ]

# A list: its rows are what grows.
printf 'file,role\none.csv,fit\ntwo b.csv,fit\n' >list.csv
any tune out/machine --runs list.csv --column "iq=Iq shaft's [A]" --column 'theta_m=Rotor mech [deg]' --column 'torque=Drehm [Nm]' -o out2
check "the list" grep -q '  Then add the new recordings to list.csv' "$work/stdout"
check "the call of a list" grep -q '^    hci-solve tune out/machine --runs list.csv --out out2 --column' "$work/stdout"
finish
