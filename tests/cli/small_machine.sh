# A small machine, target and set to spoil or to write in other ways; read after tests/support/common.sh.

m=$work/m t=$work/t.csv h=$work/h.csv
header=order,amplitude_Nm,phase_rad

# A right machine, target and set to spoil.
fresh() {
    rm -rf "$m" "$t" "$h" "$work/out"
    mkdir "$m"
    printf 'name,value,unit,source\npole_pairs,2,1,test\nemf_frequency,50,Hz,test\nconnection,star,,test\n' >"$m/machine.csv"
    printf 'order,amplitude_V,phase_rad\n1,21.93,0\n5,-5.02,0\n7,4.80,0.1\n' >"$m/back_emf.csv"
    printf '%s\n6,0.0021,1.22\n12,0.3102,1.76\n' $header >"$m/cogging.csv"
    printf '%s\n0,2,0\n6,0.1,0.5\n' $header >"$t"
    printf 'order,set\n5,sym\n7,asym\n11,neg\n13,pos\n' >"$h"
}

machine() { # ROW...: instead of the right rows
    { echo name,value,unit,source; printf '%s\n' "$@"; } >"$m/machine.csv"
}
