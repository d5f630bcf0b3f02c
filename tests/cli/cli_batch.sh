#!/bin/sh
# `batch`: words that belong together, one row and one folder a motor, bad motors, a motor that hangs, a process that is ended from outside,
# shares, results that are a mixture, and that a batch which is killed again and again ends with the bytes of one that was left alone.
#   cli_batch.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
. "$1/tests/cli/small_machine.sh"
cd "$source_dir" || exit 1

fresh
{
    echo motor,serial,batch,date,machine,target,harmonics
    for k in 01 02 03 04 05 06 07 08 09 10 11 12; do echo "m$k,$k,one,2025-01-$k,m,t.csv,h.csv"; done
    echo 'bad,13,"one, two",2025-01-13,none,t.csv,h.csv'
} >"$work/list.csv"
batch="batch $work/list.csv --command solve"

# ---- words that belong together

refused() { # CODE EXPRESSION WORD...
    wanted=$1 expression=$2
    shift 2
    run "$wanted" "$@" -o "$work/out"
    one_line_is_said
    says "$expression"
    check "something was written by $*" [ ! -e "$work/out" ]
}
refused 2 'add --command' batch "$work/list.csv"
refused 2 'such as 3/16' $batch --shard 0/2
sed '1s/harmonics/harmonic/' "$work/list.csv" >"$work/slip.csv"
refused 3 'column 7: found `harmonic`.*did you mean `harmonics`' batch "$work/slip.csv" --command solve
sed 's/^m02/m01/' "$work/list.csv" >"$work/slip.csv"
refused 3 'slip.csv:3: column 1 `motor`: found `m01`, expected each name once' batch "$work/slip.csv" --command solve
sed 's/^m02/..\/m02/' "$work/list.csv" >"$work/slip.csv"
refused 3 'a name that a folder can have' batch "$work/slip.csv" --command solve
run 2 $batch
says 'add --out'

# ---- all of it; again there is nothing to do; shares

# shellcheck disable=SC2086
{
    run 1 $batch --jobs 1 -o "$work/one"
    says '^done: 13 of 13 motors' 'done +12' 'failed +1'
    check "files: $(ls -A "$work/one" | tr '\n' ' ')" [ "$(ls -A "$work/one" | tr '\n' ' ')" = "fleet.csv fleet.sqlite motors summary.json " ]
    check "motors: $(ls -A "$work/one/motors" | wc -l)" [ "$(ls -A "$work/one/motors" | wc -l)" -eq 13 ]
    check "the bad motor is no row" grep -q '^bad,13,"one, two",2025-01-13,failed,3,,.*none: No such file' "$work/one/fleet.csv"
    check "rows are not in the order of the list" [ "$(cut -d, -f1 "$work/one/fleet.csv" | tr '\n' ' ')" = "motor m01 m02 m03 m04 m05 m06 m07 m08 m09 m10 m11 m12 bad " ]
    run 0 solve "$m" --target "$t" --harmonics "$h" -q -o "$work/alone"
    cp "$work/one/motors/m05/motor.csv" "$work/alone/"
    check "a motor is not what solve gives" diff -r "$work/alone" "$work/one/motors/m05"
    cp -Rp "$work/one" "$work/again"
    run 1 $batch --json -o "$work/again"
    check "--json differs from summary.json" cmp -s "$work/stdout" "$work/again/summary.json"
    check "done again" diff -r -x fleet.sqlite "$work/one" "$work/again"
    check "a motor was done again" [ ! "$work/again/motors/m05/motor.csv" -nt "$work/one/fleet.csv" ]
    run 0 $batch --shard 2/4 -q -o "$work/share"
    check "share" [ "$(cut -d, -f1 "$work/share/fleet.csv" | tr '\n' ' ')" = "motor m02 m06 m10 " ]
    run 3 $batch -o "$work/again" -- --strategy id0 --method pointwise
    says 'motor.csv: this motor was done with other words'
    sed -i 1s/mean_Nm/mean/ "$work/again/motors/m05/motor.csv"
    run 3 $batch -o "$work/again"
    says 'm05/motor.csv: found a row of another command or version'
    rm -r "$work/again/motors/m05"

    # the bad motor is mended: only it is done
    ln -s m "$work/none"
    run 1 $batch -q -o "$work/again"
    run 0 $batch --retry -q -o "$work/again"
    check "the mended motor is not done" grep -q '^bad,.*,done,0,reached' "$work/again/fleet.csv"
    rm "$work/none"
}

# ---- results that are a mixture: each is told by its file, and done again, and nothing else is

cp -Rp "$work/one" "$work/mixed"
sed 's/0/1/' "$work/mixed/motors/m01/currents.csv" >"$work/edited.csv"
cp "$work/edited.csv" "$work/mixed/motors/m01/currents.csv"
rm "$work/mixed/motors/m02/waveform.csv"
rm "$work/mixed/motors/m03/summary.json"
head -c 100 "$work/one/motors/m04/summary.json" >"$work/mixed/motors/m04/summary.json" # of a copy that broke off
sed 's/^0,2,/0,3,/' "$t" >"$work/other.csv"
"$hci_solve" solve "$m" --target "$work/other.csv" --harmonics "$h" -q -o "$work/mixed/motors/m06" # by hand, and it is no row
sed 's/,done,0,/,done,0,not /' "$work/one/motors/m07/motor.csv" >"$work/mixed/motors/m07/motor.csv"
cp -Rp "$work/mixed" "$work/mixed_share"
touch "$work/begun"
# shellcheck disable=SC2086
run 1 $batch --jobs 1 -o "$work/mixed"
says 'm01/currents.csv: found a file with the checksum [0-9 ]+, expected [0-9 ]+, as summary.json beside it says: .*; this motor is done again$' \
    'm02/waveform.csv: cannot be read \(No such file or directory\), expected the file that summary.json beside it names; this motor is' \
    'm03/summary.json: found none with the checksums of the files beside it' 'm04/summary.json: found none with the checksums' \
    'm06/motor.csv: found other figures than the files beside it have' 'm07/motor.csv: found other figures than the files'
check "motors that are told: $(grep -c 'done again' "$work/stderr")" [ "$(grep -c 'done again' "$work/stderr")" -eq 6 ]
check "a mixture is not done again" diff -r -x fleet.sqlite "$work/one" "$work/mixed"
check "a whole result was done again" [ -z "$(find "$work/mixed/motors/m05" "$work/mixed/motors/m08" "$work/mixed/motors/bad" -type f -newer "$work/begun")" ]
# shellcheck disable=SC2086
run 1 $batch --shard 2/4 -o "$work/mixed_share"
check "motors of a share that are told: $(cat "$work/stderr")" [ "$(grep -o 'm[0-9]*/[a-z]*\.[a-z]*: ' "$work/stderr")" = "m02/waveform.csv: 
m06/motor.csv: " ]
check "what another share has to do was taken away" cmp -s "$work/edited.csv" "$work/mixed_share/motors/m01/currents.csv"

# ---- killed at any time, and gone on

# same_rows: fleet.sqlite has the rows of fleet.csv, each once.
same_rows() {
    check "fleet.sqlite has other rows than fleet.csv" python3 - "$work/killed" <<'PY'
import csv, sqlite3, sys
rows = list(csv.DictReader(open(sys.argv[1] + "/fleet.csv")))
base = sqlite3.connect(sys.argv[1] + "/fleet.sqlite")
base.row_factory = sqlite3.Row
kept = {row["motor"]: row for row in base.execute("SELECT * FROM motor")}
assert len(kept) == len(rows)
for row in rows:
    for name, cell in row.items():
        value = kept[row["motor"]][name]
        assert (value is None and cell == "") or str(value) == cell or float(value) == float(cell), (row["motor"], name, cell, value)
PY
}

chance=7
killed=0
mkdir -p "$work/killed/motors/.m04.part" && echo stale >"$work/killed/motors/.m04.part/stale.csv" # of a process that was killed at this motor
# shellcheck disable=SC2086
while [ $killed -lt 10 ]; do
    "$hci_solve" $batch --jobs 2 -q -o "$work/killed" >"$work/stdout" 2>"$work/stderr" &
    job=$!
    chance=$(((chance * 1103515245 + 12345) % 2147483648))
    sleep "0.$(printf '%03d' $((chance / 65536 % 60)))"
    kill -KILL $job 2>/dev/null
    wait $job 2>/dev/null
    code=$?
    killed=$((killed + 1))
    [ $code -eq 137 ] || rm -rf "$work/killed/motors/m0$((killed % 9 + 1))" # it was done already
done
run 1 $batch -q -o "$work/killed"
rm -f "$work"/killed/.hci-*
check "killed and gone on is not the whole" diff -r -x fleet.sqlite "$work/one" "$work/killed"
same_rows

# ---- a motor that hangs, one whose process is ended from outside

mkfifo "$work/pipe.csv"
printf 'motor,machine,target,harmonics\nhangs,m,pipe.csv,h.csv\nm1,m,t.csv,h.csv\n' >"$work/hangs.csv"
run 1 batch "$work/hangs.csv" --command solve --jobs 1 --time-limit 0.5 -q -o "$work/late"
check "a motor that hangs is no row" grep -q '^hangs,,,,late,,,it took longer than 0.5 s,' "$work/late/fleet.csv"
check "nothing came after the motor that hangs" grep -q '^m1,,,,done,' "$work/late/fleet.csv"
"$hci_solve" batch "$work/hangs.csv" --command solve --jobs 1 -q -o "$work/crashed" 2>"$work/stderr" &
job=$!
tries=0
while ! child=$(pgrep -P $job) && [ $tries -lt 200 ]; do sleep 0.02 && tries=$((tries + 1)); done
sleep 0.1
kill -KILL "$child"
wait $job
check "exit code of a batch with a crash" [ $? -eq 1 ]
check "a crash is no row" grep -q '^hangs,,,,crashed,,,its process was ended by signal 9,' "$work/crashed/fleet.csv"
check "nothing came after the crash" grep -q '^m1,,,,done,' "$work/crashed/fleet.csv"

# ---- Ctrl-C; before it another program holds fleet.sqlite, which stops nothing

mkdir "$work/stopped"
python3 - "$work/stopped/fleet.sqlite" <<'PY' &
import os, sqlite3, sys, time
base = sqlite3.connect(sys.argv[1], isolation_level=None)
base.execute("BEGIN EXCLUSIVE")
open(sys.argv[1] + ".held", "w").close()
until = time.monotonic() + 30
while os.path.exists(sys.argv[1] + ".held") and time.monotonic() < until:
    time.sleep(0.02)
PY
tries=0
while ! [ -e "$work/stopped/fleet.sqlite.held" ] && [ $tries -lt 400 ]; do sleep 0.02 && tries=$((tries + 1)); done
env --default-signal=INT "$hci_solve" batch "$work/hangs.csv" --command solve --jobs 2 -o "$work/stopped" >"$work/stdout" 2>"$work/stderr" &
job=$!
tries=0
while ! [ -e "$work/stopped/fleet.csv" ] && [ $tries -lt 200 ]; do sleep 0.02 && tries=$((tries + 1)); done
check "a file that another program holds stops the batch" grep -q '^m1,,,,done,' "$work/stopped/fleet.csv"
rm -f "$work/stopped/fleet.sqlite.held"
kill -INT $job
wait $job
check "exit code after Ctrl-C" [ $? -eq 130 ]
says '^not done yet: 1 of 2 motors' 'the same command goes on from there'
check "fleet.csv after Ctrl-C" grep -q '^m1,,,,done,' "$work/stopped/fleet.csv"
check "fleet.sqlite after it was held" python3 -c 'import sqlite3, sys
assert sqlite3.connect(sys.argv[1]).execute("SELECT motor, state FROM motor").fetchall() == [("m1", "done")]' "$work/stopped/fleet.sqlite"

# ---- fit: one direction and one kind of current do not tell the strength of the magnets and the angle apart; what is not used is said

mkdir "$work/fit"
cat >"$work/fit.py" <<'PY'
import math, os, random, sys
os.chdir(sys.argv[1])
random.seed(1)
os.mkdir("m")
for name, text in (("machine", "name,value,unit,source\npole_pairs,2,1,test\nemf_frequency,50,Hz,test\nconnection,star,,test\n"),
                   ("back_emf", "order,amplitude_V,phase_rad\n1,21.93,0\n"), ("cogging", "order,amplitude_Nm,phase_rad\n6,0,0\n")):
    open(f"m/{name}.csv", "w").write(text)
for name, current, without in (("light", 2, ()), ("full", 4, (100, 101, 500)), ("idle", 0, range(512))):
    with open(name + ".csv", "w") as f:
        f.write("time_s,theta_m_rad,ia_A,ib_A,ic_A" + ("\n" if name == "idle" else ",torque_Nm\n"))
        for k in range(512):
            angle = 4 * math.pi * k / 512
            row = [k / 512, angle] + [current * math.sin(2 * angle - s * 2 * math.pi / 3) + random.gauss(0, 0.02) for s in range(3)]
            torque = 0.97 * current * 1.5 * 21.93 / (math.pi * 50) + 0.05 * math.sin(12 * angle) + 0.01 * math.cos(4 * angle) + random.gauss(0, 0.005)
            cells = [str(x) for x in row] + ([] if name == "idle" else ["" if k in without else str(torque)])
            f.write(",".join(cells) + "\n")
open("runs.csv", "w").write("file,role\nlight.csv,fit\nfull.csv,fit\nidle.csv,fit\n")
open("motors.csv", "w").write("motor,machine,runs\none,m,runs.csv\n")
PY
python3 "$work/fit.py" "$work/fit" || fail "fit.py"
run 0 fit "$work/fit/m" --runs "$work/fit/runs.csv" -o "$work/fit/out"
says '1 of 3 recordings are not used; the first, idle.csv, is without a measured torque' '3 rows of the recordings have a hole' '; 1021 samples' \
    'position_offset angle: not told'
check "an ill-told fit: $(cat "$work/fit/out/parameters.csv")" python3 - "$work/fit/out" <<'PY'
import csv, json, sys
s = json.load(open(sys.argv[1] + "/summary.json"))
p = {(r["effect"], r["parameter"]): r for r in csv.DictReader(open(sys.argv[1] + "/parameters.csv"))}
magnets = p["back_emf", "common"]
assert s["found"] and s["rms_after_Nm"] <= s["rms_before_Nm"]
assert p["position_offset", "angle"]["value"] == ""
assert abs(float(magnets["value"]) + 0.03) < 3 * float(magnets["std_error"]) < 0.1
PY
run 0 batch "$work/fit/motors.csv" --command fit --jobs 1 -q -o "$work/fit/batch"
check "fleet.csv of a fit: $(cat "$work/fit/batch/fleet.csv")" grep -q '^one,.*,done,0,,"1 of 3 recordings are not used; .*; 3 rows .*",1021,1,3,' "$work/fit/batch/fleet.csv"

# Of a diagnosis the folders within; and what fleet reads.
run 0 fleet "$work/fit/batch" -o "$work/fit/out_batch"
cp -R "$work/fit/batch" "$work/fit/mixed"
sed -i 's/^back_emf,common,/&1/' "$work/fit/mixed/motors/one/parameters.csv"
run 3 fleet "$work/fit/mixed" -o "$work/fit/out_mixed"
says 'one/parameters.csv: found a file with the checksum [0-9 ]+, expected [0-9 ]+, .*; the same hci-solve batch again writes it anew$'
check "a line of a mixture was written" [ ! -e "$work/fit/out_mixed" ]
run 0 batch "$work/fit/motors.csv" --command fit --jobs 1 -o "$work/fit/mixed"
says 'one/parameters.csv: found a file with the checksum .*; this motor is done again$'
check "a fit that is a mixture" diff -r -x fleet.sqlite "$work/fit/batch" "$work/fit/mixed"
sed -i 's/,done,/,open,/' "$work/fit/mixed/fleet.csv"
run 3 fleet "$work/fit/mixed" -o "$work/fit/out_mixed"
says 'mixed/fleet.csv: found a file with the checksum [0-9 ]+, expected [0-9 ]+, .*; the same hci-solve batch again writes it anew$'
"$hci_solve" batch "$work/fit/motors.csv" --command diagnose --jobs 1 -q -o "$work/fit/diagnosed"
sed -i 's/^back_emf,common,/&1/' "$work/fit/diagnosed/motors/one/fit/parameters.csv"
"$hci_solve" batch "$work/fit/motors.csv" --command diagnose --jobs 1 -o "$work/fit/diagnosed" >"$work/stdout" 2>"$work/stderr"
says 'one/fit/parameters.csv: found a file with the checksum .*; this motor is done again$'

# ---- limits: pass, fail, not told; the voltages of open terminals tell the magnets

awk 'BEGIN { pi = atan2(0, -1)
    print "time_s,theta_m_rad,speed_rad_per_s,va_V,vb_V,vc_V"
    for (k = 0; k < 400; k++) { a = 4 * pi * k / 400
        printf "%.9g,%.9g,%.9g", k / 400, a, 4 * pi
        for (s = 0; s < 3; s++) printf ",%.9g", 0.97 * 4 * pi * 21.93 / (50 * pi) * sin(2 * a - s * 2 * pi / 3) + 1e-4 * ((k * 7919 + s * 31) % 97 - 48)
        print "" } }' >"$work/fit/coast.csv"
sed '4s/.*/coast.csv,fit/' "$work/fit/runs.csv" >"$work/fit/voltages.csv"
printf 'effect,parameter,low,high\nback_emf,by_voltage,-0.0301,-0.0299\nresidual,rms,,0.02\nfriction,viscous,,\n' >"$work/pass.csv"
printf 'effect,parameter,low,high\nback_emf,common,0,1\nposition_offset,angle,-1,1\nresidual,rms,,0.02\n' >"$work/fail.csv"
printf 'effect,parameter,low,high\nback_emf,comon,0,1\n' >"$work/slip.csv"
run 0 fit "$work/fit/m" --runs "$work/fit/voltages.csv" --limits "$work/pass.csv"
says 'pass +0 of 2 parameters' 'back_emf by_voltage: -0.03' '3 rows of the recordings have a hole'
check "a run whose voltages are used is not used: $(cat "$work/stderr")" [ -z "$(grep 'are not used; the first' "$work/stderr")" ]
run 1 fit "$work/fit/m" --runs "$work/fit/runs.csv" --limits "$work/fail.csv" -o "$work/fit/failed"
says 'fail +2 of 3 parameters' 'back_emf common: found -0\.0[0-9]+, expected 0 … 1' 'position_offset angle: not told, expected -1 … 1'
check "the verdict: $(cat "$work/fit/failed/summary.json")" grep -q '"verdict":.*"fail"' "$work/fit/failed/summary.json"
run 3 fit "$work/fit/m" --runs "$work/fit/runs.csv" --limits "$work/slip.csv"
says 'slip.csv:2: column 2 `parameter`: found `comon`, expected an effect and a parameter of parameters.csv'
echo effect,param,low,high >"$work/slip.csv"
run 3 fit "$work/fit/m" --runs "$work/fit/runs.csv" --limits "$work/slip.csv"
says 'slip.csv:1: found no column `parameter` but `effect`, `param`'

# ---- fleet: motors without a result, a name with a comma and quotes, dates in other forms, the batch that differs

{
    echo motor,batch,date,machine,runs
    for k in 1 2 3 4 5 6; do echo "n$k,b$((k % 2)),0$k.10.2026,m,$([ $((k % 2)) = 1 ] && echo runs || echo voltages).csv"; done
    echo '"lost, ""it""",b1,7.10.26,m,none.csv'
} >"$work/fit/line.csv"
run 1 batch "$work/fit/line.csv" --command fit --jobs 1 -q -o "$work/fit/line" -- --limits "$work/fail.csv"
check "fleet.csv of a fit with limits: $(cat "$work/fit/line/fleet.csv")" grep -q '^n1,,b1,01.10.2026,open,1,fail,' "$work/fit/line/fleet.csv"
run 0 fleet "$work/fit/line" -o "$work/fit/out_line"
says 'no result +1 motors' 'dates +1 are not read, such as `7.10.26`: no trend is from them; write YYYY-MM-DD'
for table in fleet deviations; do
    check "the name of a motor in $table.csv" grep -q '^"lost, ""it""",' "$work/fit/out_line/$table.csv"
done

finish
