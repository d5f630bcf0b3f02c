#!/bin/sh
# Wrong input files: exit code 3, file and line and a remedy on standard error, nothing on standard output and nothing
# written.
#   cli_bad_input.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
. "$1/tests/cli/small_machine.sh"

# refused CODE EXPRESSION... [-- OPTION...]: what the files are now is refused, and says each expression.
refused() {
    code_wanted=$1
    shift
    expressions=
    while [ $# -gt 0 ] && [ "$1" != -- ]; do
        expressions="$expressions$1
"
        shift
    done
    [ $# -eq 0 ] || shift
    run "$code_wanted" solve "$m" --target "$t" -o "$work/out/sub" "$@"
    nothing_on_stdout
    one_line_is_said
    old_ifs=$IFS
    IFS='
'
    for expression in $expressions; do says "$expression"; done
    IFS=$old_ifs
    check "something was written" [ ! -e "$work/out" ]
    fresh
}

fresh
run 0 solve "$m" --target "$t" --harmonics "$h" -q
fresh

# ---- folders and files

rm -r "$m"; refused 3 '/m: No such file or directory; expected the folder of a machine with machine.csv'
rm -r "$m"; echo x >"$m"; refused 3 '/m: found a file, expected the folder of a machine'
run 2 solve '' --target "$t"; says 'found an empty word, expected MACHINE'; nothing_on_stdout
rm "$m/machine.csv"; refused 3 '/m/machine.csv: .*(No such file|not exist)'
rm "$m/back_emf.csv"; refused 3 '/m/back_emf.csv: No such file; expected the orders of the back-EMF; .*init.*harmonics'
rm "$t"; refused 3 '/t.csv: .*(No such file|not exist)'
rm "$h"; refused 3 '/h.csv: .*(No such file|not exist)' -- --harmonics "$h"
for file in machine.csv back_emf.csv cogging.csv; do
    rm "$m/$file"; mkdir "$m/$file"; refused 3 "/m/$file: .*(folder|directory)"
    : >"$m/$file"; refused 3 "/m/$file(:1)?: found no line of text, expected a header row"
    printf '# only a comment\n' >"$m/$file"; refused 3 "/m/$file(:[0-9]+)?: "
    ln -sf nowhere "$m/$file"; [ $file = cogging.csv ] && fresh || refused 3 "/m/$file: .*No such file"
    chmod 000 "$m/$file"
    if [ -r "$m/$file" ]; then fresh; else refused 3 "/m/$file: .*Permission denied"; fi
done
rm "$t"; mkdir "$t"; refused 3 '/t.csv: .*(folder|directory)'
: >"$t"; refused 3 '/t.csv(:1)?: found no line of text, expected a header row'
printf '%s\n' $header >"$t"; refused 3 '/t.csv(:1)?: no rows, expected at least the mean torque'
printf 'order,amplitude_V,phase_rad\n' >"$m/back_emf.csv"; refused 3 '/back_emf.csv(:1)?: no rows, expected at least order 1'
printf 'name,value,unit,source\n' >"$m/machine.csv"; refused 3 '/machine.csv(:1)?: no .pole_pairs.; add a row'
refused 3 '/dev/null' -- --harmonics /dev/null

# ---- machine.csv

hz=emf_frequency,50,Hz,test
machine "$hz"; refused 3 'machine.csv: no .pole_pairs.; add a row .pole_pairs,N,1,source.'
for value in 0 -2 3.5 1001 1e300 \"2,5\"; do
    machine "pole_pairs,$value,1,x" "$hz"; refused 3 'machine.csv(:2)?: .pole_pairs.: found .*, expected a whole number from 1 to 1000; .*N/2 pole pairs'
done
for value in four '' nan inf 1e999 0x2 '2 2' 2,5,5; do
    machine "pole_pairs,\"$value\",1,x" "$hz"; refused 3 'machine.csv:2: .*value' 'found' 'expected'
done
machine pole_pairs,2,1,x pole_pairs,2,1,x "$hz"; refused 3 'machine.csv:3: .*name.*pole_pairs.*each name once; delete one'
machine pole_pairs,2,1,x "$hz" connection,delta,,x; refused 3 'machine.csv:4: .*delta.*expected .star. or .star-neutral.; .*equivalent star'
machine pole_pairs,2,1,x "$hz" connection,,,x; refused 3 'machine.csv:4: .*expected .star. or .star-neutral.'
machine pole_pairs,2,1,x; refused 3 'back_emf.csv.*in volts.*emf_frequency.*add the electrical frequency'
machine pole_pairs,2,1,x emf_frequency,0,Hz,x; refused 3 'emf_frequency'
machine pole_pairs,2,1,x emf_frequency,-50,Hz,x; refused 3 'emf_frequency'
machine pole_pairs,2,1,x emf_frequency,50,furlong,x; refused 3 'machine.csv:3: .*unit.*furlong.*expected a unit that converts to Hz'
machine pole_pairs,2,1,x emf_frequency,50,V,x; refused 3 'machine.csv:3: .*unit.*expected a unit that converts to Hz'
for row in resistance,-0.1,ohm inductance_d,-1,mH inductance_q,0,mH inductance_d,30, inductance_q,30,H max_current,0,A max_current,-5,A dc_link_voltage,0,V dc_link_voltage,-12,V \
    rated_current,-5,A rated_torque,0,Nm rated_speed,-3000,rpm inertia,-1,kgm2 viscous_friction,-1,Nms_per_rad coulomb_friction,-1,Nm; do
    machine pole_pairs,2,1,x "$hz" "$row,x"; refused 3 'machine.csv:4: .*value.*found .*, expected a number from .* to .*; check its sign, and that the column .unit. says'
done
machine pole_pairs,2,1,x "$hz" colour,5,,x max_curent,5,A,x
run 0 solve "$m" --target data/scenarios/02/target.csv
says 'note: .*machine.csv: not used: `max_curent` in line 5 \(did you mean `max_current`\?\), `colour`$'
machine pole_pairs,2,1,x "$hz" resistance,1,N,x; refused 3 'machine.csv:4: .*unit.*ohm'
printf 'name,unit,source\npole_pairs,1,x\n' >"$m/machine.csv"; refused 3 'machine.csv:1: .*value'
printf 'value,unit\n2,1\n' >"$m/machine.csv"; refused 3 'machine.csv:1: .*name'

# ---- what is there but not yet understood is not left out in silence

printf 'theta_e_rad,La_H,Lb_H,Lc_H,Mab_H,Mbc_H,Mca_H\n0,1,1,1,0,0,0\n' >"$m/inductance.csv"; refused 3 'inductance.csv'
effects='effect,parameter,value,unit,std_error'
echo order,amplitude_Nm >"$m/effects.csv"; refused 3 'effects.csv:1: found no column `effect` but `order`, `amplitude_Nm`' # and no row
printf '%s\nwobble,a,1,,\n' $effects >"$m/effects.csv"; refused 3 'effects.csv:2: .*`wobble`, expected one of cogging'
printf '%s\nsaturation,d9q0_sine_6,1,Nm,\n' $effects >"$m/effects.csv"; refused 3 'effects.csv:2: .*`d9q0_sine_6`, expected one of d3q0_sine_ORDER'
printf '%s\nsaturation,d0q3_sine_0.3333,1,Nm,\n' $effects >"$m/effects.csv"; refused 3 'no common period .*k/pole_pairs'
printf '%s\ncogging,sine_0.3333,1,Nm,\n' $effects >"$m/effects.csv"; refused 3 'effects.csv: .*no common period .*k/pole_pairs'
sed -i 's/star,/star-neutral,/' "$m/machine.csv"; printf '%s\nsaturation,d0q3_sine_6,0.001,Nm,\n' $effects >"$m/effects.csv"; refused 3 'star connection only'
refused 2 '--temperature' -- --temperature warm

# ---- any table: what is wrong, and where

table() { # PATH NAME HEADER GOOD_ROW OPTIONS...
    file=$1 shown_name=$2 columns=$3 good=$4
    shift 4
    where="/$shown_name:3"
    set_table() { printf '%s\n%s\n%s\n' "$columns" "$good" "$1" >"$file"; }
    set_table 12,x,0;                         refused 3 "$where: .*found .x., expected" -- "$@"
    set_table 12,,0;                          refused 3 "$where: " -- "$@"
    for number in nan inf -inf 1e999 0x1 1e '1 2' '1.2.3' --1 +-1 '1,5'; do
        set_table "12,\"$number\",0";         refused 3 "$where: .*found" 'expected' -- "$@"
    done
    set_table 12,1;                           refused 3 "$where: .*" -- "$@"
    set_table 12,1,0,4,5,6;                   refused 3 "$where: .*" -- "$@"
    set_table -6,1,0;                         refused 3 "$where: .*order.*expected an order of 0 or more; .*positive" -- "$@"
    set_table "$good";                        refused 3 "/$shown_name:[23]: .*order.*each order once; join the two rows" -- "$@"
    set_table '12,1,"0';                      refused 3 "/$shown_name:[34]: .*quot" -- "$@"
    printf '%s\n%s' "${columns%,*}" "${good%,*}" >"$file"; refused 3 "/$shown_name:1: .*phase" 'expected|add|needs' -- "$@"
    printf 'order,%s\n1,%s\n' "$columns" "$good" >"$file"; refused 3 "/$shown_name:1: .*order.*(twice|once|duplicate)" -- "$@"
    printf '%s,phase_deg\n%s,0\n' "$columns" "$good" >"$file"; refused 3 "/$shown_name:1: .*phase" -- "$@"
    printf '%s\n%s\n' "$columns" "$good" | sed 's/phase_rad/phase_V/' >"$file"; refused 3 "/$shown_name:1: .*phase" -- "$@"
    set_table "12,1,0$(printf '\001')";       refused 3 "$where: " -- "$@"
    printf '%s\n%s\n12,1\0,0\n' "$columns" "$good" >"$file"; refused 3 "/$shown_name(:3)?: .*(NUL|zero byte|binary|UTF-16)" -- "$@"
    printf '%s\n' "$columns" | head -c 9 >"$file"; refused 3 "/$shown_name:1: " -- "$@"
    printf '<html><body>not found</body></html>\n' >"$file"; refused 3 "/$shown_name:1: " -- "$@"
}
table "$t" t.csv order,amplitude_Nm,phase_rad 6,0.1,0.5
table "$m/cogging.csv" cogging.csv order,amplitude_Nm,phase_rad 6,0.1,0.5
table "$m/back_emf.csv" back_emf.csv order,amplitude_V,phase_rad 1,21.93,0

# ---- what only one of the tables refuses

emf() { printf 'order,amplitude_V,phase_rad\n1,21.93,0\n%s\n' "$1" >"$m/back_emf.csv"; }
emf 2.5,1,0; refused 3 'back_emf.csv:3: .*order.*2.5.*expected a whole electrical order from 1; .*name the column mechanical_order'
emf 0,1,0;   refused 3 'back_emf.csv:3: .*order.*expected a whole electrical order from 1'
printf 'order,amplitude_A,phase_rad\n1,21.93,0\n' >"$m/back_emf.csv"; refused 3 'back_emf.csv:1: .*amplitude_V'
printf 'order,amplitude_V,phase_rad\n1,0,0\n' >"$m/back_emf.csv"; refused 3 'back_emf.csv: every amplitude is zero'
mean() { printf '%s\n%s\n' $header "$1" >"$t"; }
mean 0,2,1;      refused 3 't.csv:2: .*phase_rad.*1.*expected 0 or 1.5708 .*; order 0 is the mean: its amplitude is signed'
mean 0,2,3.1416; refused 3 't.csv:2: .*phase_rad'
weighted() { printf '%s,weight\n0,2,0,1\n6,1,0,%s\n' $header "$1" >"$t"; }
weighted -1;     refused 3 't.csv:3: .*weight.*-1.*expected.*0'
weighted nan;    refused 3 't.csv:3: .*weight'
weighted '';     refused 3 't.csv:3: .*weight'
printf '%s\n0,2,0\n5.7654321,1,0\n6.1234567,1,0\n7.2718281,1,0\n' $header >"$t"; refused 3 'no common period.*k/pole_pairs'

# Work that grows faster than the rows is refused before it begins.
rows_of() { awk -v n="$1" -v row="$2" 'BEGIN { for (k = 1; k <= n; ++k) { printf "%.2f,", k / 100; print row } }'; }
{ echo $header; rows_of 10001 0.1,0; } >"$t"
refused 3 't.csv: found 10001 rows, expected at most 10000; keep the orders that matter'
{ echo $header; rows_of 10001 0.1,0; } >"$m/cogging.csv"
refused 3 'cogging.csv: found 10001 rows, expected at most 10000; keep the orders that matter'
{ echo order,set; rows_of 10001 pos; } >"$h"
refused 3 'h.csv: found 10001 rows, expected at most 10000; keep the orders that matter' -- --harmonics "$h"
{ echo order,set,amplitude_A,phase_rad; rows_of 10001 pos,0.1,0; } >"$work/currents.csv"
run 3 emit "$work/currents.csv" --name x -o "$work/out"
says 'currents.csv: found 10001 rows, expected at most 10000; keep the orders that matter'
awk 'BEGIN { print "file,role"; for (k = 0; k < 4097; ++k) print "run_" k ".csv,fit" }' >"$work/runs.csv"
run 3 diagnose "$m" --runs "$work/runs.csv" -o "$work/out"
says 'runs.csv: found 4097 rows, expected at most 4096; join short recordings, or leave some out'

set_of() { printf 'order,set\n5,neg\n%s\n' "$1" >"$h"; }
for name in symm positive '' 'pos ition' 1; do
    set_of "7,$name"; refused 3 'h.csv:3: .*set.*expected .pos., .neg., .sym. or .asym., or .zero. with a neutral;' -- --harmonics "$h"
done
set_of 9,sym;   refused 3 'h.csv:3: .*set.*sym.*star connection.*divisible by three' -- --harmonics "$h"
set_of 3,zero;  refused 3 'h.csv:3: .*star' -- --harmonics "$h"
set_of 2.5,sym; refused 3 'h.csv:3: .*order.*2.5.*whole order with .sym.; use .pos. or .neg.' -- --harmonics "$h"
set_of -7,pos;  refused 3 'h.csv:3: .*order.*-7.*order of 0 or more; .*other sequence' -- --harmonics "$h"
set_of x,pos;   refused 3 'h.csv:3: .*order.*found .x.' -- --harmonics "$h"
set_of 7;       refused 3 'h.csv:3: ' -- --harmonics "$h"
set_of 7,pos,1; refused 3 'h.csv:3: ' -- --harmonics "$h"
set_of 1,pos;   refused 3 'pos 1, which is held fixed; leave it out' -- --harmonics "$h" --fundamental 12,0.2
set_of 1,asym;  refused 3 'asym 1, which is held fixed; leave it out' -- --harmonics "$h" --fundamental 12,0.2
printf 'order\n5\n' >"$h";            refused 3 'h.csv:1: .*no column .set.; expected the columns order,set' -- --harmonics "$h"
printf 'harmonic,set\n5,neg\n' >"$h"; refused 3 'h.csv:1: .*order' -- --harmonics "$h"
printf 'order,set\n5,neg\n5,sym\n' >"$h" # the same component: counted once, and said
run 1 solve "$m" --target "$t" --harmonics "$h"
says 'note: neg 5 and sym 5 are the same component and count once'
fresh

finish
