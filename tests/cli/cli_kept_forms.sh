#!/bin/sh
# The forms of what is emitted, byte for byte but for digests and what rounding changes, and drives that are played with all that a
# scenario can say, are those in tests/files/kept/forms.txt: what no other test looks at must not change unnoticed. After a change that is
# meant: --renew, and look at the differences.
#   cli_kept_forms.sh SOURCE_DIR BUILD_DIR HCI_SOLVE [--renew]
. "$1/tests/support/common.sh"
use_plain_build
. "$source_dir/tests/cli/kept_inputs.sh"
drive=data/drive/machine_a_10kHz.csv
kept auto 0 solve $a --target $t --auto
sed '/^0,/s/^0,[^,]*/0,1/' $t >half.csv
kept half 1 solve $a --target half.csv --harmonics few.csv

# Formats, shapes and frames.
for form in 'f32 --frame dq' 'i16 --shape linear' 'i16 --shape quadratic --frame dq' 'q15 --shape cubic --per-torque' \
    'i8 --max-error 0.3' 'csv --frame dq --per-torque' 'json --per-torque --reference-torque 3' 'q15 --max-bytes 200' 'i16 --max-instructions 120'; do
    # shellcheck disable=SC2086
    kept "table_$(echo "$form" | tr ' -' '_.')" 0 emit kept/auto --name table --machine $a --format $form
done
for form in f32 i16 q15 i8; do
    kept "blob_$form" 0 emit kept/auto --name table --format $form --max-error 0.4 --blob --per-torque
done
kept logs 0 emit kept/auto --name logs --angle-of-logs --angle-offset 33.5 --points 16

# Loops: of one solution for each torque, of levels, up to a speed.
kept loop_per_torque 0 emit kept/auto --name loop --machine $a --drive $drive --per-torque --blob
kept loop_levels 0 emit kept/half kept/auto --name loop --machine $a --drive $drive --speed 700

# Other drives' own forms.
kept simplefoc 0 emit kept/auto --name map --for simplefoc --machine $a --points 32
kept mcsdk 0 emit kept/auto --name map --for st-mcsdk --machine $a --counts-per-ampere 1000 --encoder-direction -1
kept novanta 0 emit kept/auto --name map --for novanta --machine $a --torque-constant 0.25 --encoder-offset 20
kept map_csv 0 emit kept/auto --name map --for csv --machine $a --points 64 --encoder-offset -7
for wave in sine cosine sine-lag cosine-lag; do
    kept "beckhoff_$wave" 0 emit kept/auto --name map --for beckhoff --machine $a --wave $wave
done

# Scenarios.
scene() {
    name=$1 machine=$2
    { printf 'name,value,unit\n'; tr ';' '\n'; } >"$name.csv"
    kept "$name" 0 simulate "$machine" "$name.csv"
}
scene hysteresis m <<'X'
duration,20,ms;settle,10,ms;current_control,hysteresis,;strategy,id0,;prescribed_speed,300,rpm;torque_reference,1,Nm;dc_link_voltage,60,V;hysteresis_band,0.4,A;switching_frequency_max,15,kHz
X
scene pi m <<'X'
duration,60,ms;settle,30,ms;current_control,pi,;strategy,id0,;strategy_2,cancel,;strategy_2_from,25,ms;prescribed_speed,200,rpm;torque_reference,1.2,Nm;dc_link_voltage,60,V;dead_time,1,us;dead_time_crossing,0.2,A;dead_time_compensation,1,;current_filter_time,50,us;current_quantum,20,mA;encoder_counts,4096,;current_limit,9,A
X
scene pi_late m <<'X'
duration,40,ms;settle,20,ms;current_control,pi,;prescribed_speed,-200,rpm;torque_reference,0.8,Nm;dc_link_voltage,60,V;current_sample_time,50,us;current_kp,1.1,ohm;current_ki,150,V/(A*s);current_kp_q,1.3,ohm;current_ki_q,170,V/(A*s);pwm_delay,0,;decoupling,0,;current_delay,50,us;angle_delay,100,us;angle_offset,0.02,rad;current_offset_a,0.1,A;current_gain_b,0.01,
X
scene speed m <<'X'
duration,0.4,s;settle,0.2,s;current_control,pi,;strategy,mtpa,;speed_reference,100,rpm;initial_speed,80,rpm;initial_angle,0.3,rad;inertia,2e-4,kgm2;viscous_friction,1e-3,Nms_per_rad;coulomb_friction,0.02,Nm;load_torque,0.2,Nm;load_torque_2,0.5,Nm;load_torque_2_from,0.1,s;dc_link_voltage,60,V;torque_limit,1.5,Nm;speed_noise,0.1,rad_per_s;current_noise,10,mA;angle_noise,1,mrad;seed,4,
X
scene coasting m <<'X'
duration,0.2,s;current_control,ideal,;torque_reference,0,Nm;initial_speed,20,rad_per_s;inertia,1e-3,kgm2;coulomb_friction,0.05,Nm;viscous_friction,2e-3,Nms_per_rad;torque_noise,3,mNm;step,50,us
X
scene limited data/machine_c <<'X'
duration,60,ms;current_control,ideal,;strategy,cancel,;prescribed_speed,500,rpm;torque_reference,2,Nm;id_limit,1,A;iq_limit,3,A
X
kept_all forms "${4-}"
finish
