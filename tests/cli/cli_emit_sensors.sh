#!/bin/sh
# Macros of an emitted header that a firmware corrects its sensors by: a program with that header gets the true sample back
# from what the core says that the sensors read. The source of the table compiles with them.
#   cli_emit_sensors.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"
build=$(dirname "$3")
sanitizers=
if nm "$build/src/core/libhci_core.a" 2>"$work/nm" | grep -q __asan_; then sanitizers=-fsanitize=address,undefined; fi

cp -r "$source_dir/data/machine_a" "$work/m"
cat >"$work/m/effects.csv" <<'ROWS'
effect,parameter,value,unit,std_error
current_gain,a,0.1,1,
current_gain,b,-0.2,1,
current_offset,a,0.5,A,
current_offset,c,-1,A,
position_offset,angle,0.02,rad,
position_eccentricity,mech_sine_1,0.0002,rad,
position_eccentricity,mech_cosine_2,-0.0001,rad,
ROWS
printf 'order,set,amplitude_A,phase_rad\n1,pos,10,0.3\n5,neg,1.5,-1\n' >"$work/currents.csv"
run 0 emit "$work/currents.csv" --name servo --machine "$work/m" --points 48 -o "$work/out"

cat >"$work/drive.c" <<'PROGRAM'
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/effects/effect.h"
#include "servo.h"

static const struct {
    const char *effect, *parameter;
    double value, order;
} ROW[] = {{"current_gain", "a", 0.1, 0},
           {"current_gain", "b", -0.2, 0},
           {"current_offset", "a", 0.5, 0},
           {"current_offset", "c", -1.0, 0},
           {"position_offset", "angle", 0.02, 0},
           {"position_eccentricity", "mech_sine", 0.0002, 1},
           {"position_eccentricity", "mech_cosine", -0.0001, 2}};
enum { ROWS = sizeof ROW / sizeof *ROW };

static hci_effect effect[ROWS];
static hci_effect_term term[ROWS];

static size_t parameter_of(const hci_effect_type *type, const char *name)
{
    size_t k = 0;
    while (strcmp(type->parameter[k].name, name) != 0)
        ++k;
    return k;
}

int main(void)
{
    double worst_A = 0.0, worst_rad = 0.0;
    for (size_t k = 0; k < ROWS; ++k) {
        effect[k].type = hci_effect_type_find(ROW[k].effect);
        term[k].parameter = parameter_of(effect[k].type, ROW[k].parameter);
        term[k].value = ROW[k].value;
        term[k].order = ROW[k].order;
        effect[k].term = &term[k];
        effect[k].count = 1;
    }
    for (double theta_m = 0.0; theta_m < 6.3; theta_m += 0.1) {
        const hci_effects effects = {effect, ROWS};
        hci_sample truth;
        memset(&truth, 0, sizeof truth);
        truth.theta_m_rad = theta_m;
        truth.i_abc[0] = 3.0 * sin(theta_m), truth.i_abc[1] = 2.0 * cos(theta_m), truth.i_abc[2] = 1.0;
        const hci_sample read = hci_effects_sense(&effects, servo_POLE_PAIRS, &truth);
        worst_A = fmax(worst_A, fabs(servo_TRUE_IA(read.i_abc[0]) - truth.i_abc[0]));
        worst_A = fmax(worst_A, fabs(servo_TRUE_IB(read.i_abc[1]) - truth.i_abc[1]));
        worst_A = fmax(worst_A, fabs(servo_TRUE_IC(read.i_abc[2]) - truth.i_abc[2]));
        double theta = read.theta_m_rad - servo_THETA_ZERO_RAD / servo_POLE_PAIRS;
        theta -= servo_THETA_M_SIN1_RAD * sin(theta) + servo_THETA_M_COS2_RAD * cos(2.0 * theta);
        worst_rad = fmax(worst_rad, fabs(theta - theta_m));
    }
    printf("%.3g A, %.3g rad\n", worst_A, worst_rad);
    return !(worst_A < 1e-5 && worst_rad < 5e-7);
}
PROGRAM
cc=${CC:-cc}
$cc -std=c99 -Wall -Wextra -Werror -I"$source_dir/include" -I"$work/out" -c "$work/out/servo.c" -o "$work/servo.o" ||
    fail "the table does not compile with its macros"
$cc -std=c99 -I"$source_dir/include" -I"$work/out" "$work/drive.c" "$work/servo.o" "$build/src/core/libhci_core.a" \
    $sanitizers -lm -o "$work/drive" || fail "the program does not compile"
said=$("$work/drive") || fail "readings are not corrected: $said off"
says_file() { grep -qF -- "$1" "$work/out/servo.h" || fail "servo.h does not say: $1"; }
says_file ' *           i_a = (i_a_read - 0.5 A) * 0.90909'
says_file ' *           i_c = (i_c_read + 1 A)'
says_file ' *           theta = theta_read - 0.02 rad (electrical)'
finish
