#!/bin/sh
# Upload scripts of `emit --for` with stand-ins for the packages and the programmer that they use: nothing is imported or sent
# without --store, and with it what arrives is what stands in the file of the map.
#   foreign_scripts.sh SOURCE_DIR BUILD_DIR HCI_SOLVE
. "$1/tests/support/common.sh"

command -v python3 >/dev/null || { echo "skipped: no python3 here"; exit 77; }
cd "$source_dir" || exit 1
run 0 solve data/machine_a --target data/scenarios/02/target.csv --auto --quiet -o "$work/currents"
for target in moteus novanta beckhoff 'openffboard --counts-per-ampere 437'; do
    # shellcheck disable=SC2086
    run 0 emit "$work/currents" --machine data/machine_a --for $target --name map --quiet -o "$work/${target%% *}"
done

# Stand-ins: each writes what it is given, a call a line, into the file $SENT.
mkdir -p "$work/packages/ingenialink/ethercat" "$work/bin"
cat >"$work/packages/sent.py" <<'PY'
import os

def sent(*words):
    with open(os.environ["SENT"], "a", encoding="utf-8") as file:
        print(*words, file=file)
PY
cat >"$work/packages/moteus.py" <<'PY'
from sent import sent

class Controller:
    def __init__(self, id=1):
        self.id = id

class Stream:
    def __init__(self, controller):
        self.id = controller.id
    async def write_message(self, data):
        sent(self.id, data.decode("ascii"))
    async def flush_read(self):
        pass
    async def command(self, data):
        sent(self.id, data.decode("ascii"))
PY
cat >"$work/packages/pyads.py" <<'PY'
import struct
from sent import sent

PLCTYPE_BYTE = __import__("ctypes").c_ubyte

class Connection:
    def __init__(self, net_id, port):
        self.where = (net_id, port)
    def __enter__(self):
        return self
    def __exit__(self, *_):
        pass
    def write(self, group, offset, value, kind):
        assert len(value) == kind._length_ and group == 0xF302
        number = struct.unpack({2: "<h", 4: "<f" if offset & 0xFF > 6 and (offset & 0xFF) % 3 != 1 or offset & 0xFF == 2 else "<I"}[len(value)], bytes(value))[0]
        sent(*self.where, f"{offset >> 16:#06x}:{offset & 0xFFFF:02x} {number:.6g}")
PY
touch "$work/packages/ingenialink/__init__.py" "$work/packages/ingenialink/ethercat/__init__.py"
cat >"$work/packages/ingenialink/ethercat/network.py" <<'PY'
from sent import sent

class Servo:
    def __init__(self):
        self.table, self.index = {}, 0
    def write(self, register, value, axis):
        if register == "COGGING_COMP_TABLE_INDEX":
            self.index = value
        else:
            sent(axis, self.index, f"{value:.6g}")
    def read(self, register, axis):
        return self.index * 0.25

class EthercatNetwork:
    def __init__(self, interface):
        sent("interface", interface)
    def connect_to_slave(self, slave, dictionary):
        sent("slave", slave, dictionary)
        return Servo()
PY
printf '#!/bin/sh\necho "$@" >>"$SENT"\n' >"$work/bin/STM32_Programmer_CLI"
chmod +x "$work/bin/STM32_Programmer_CLI"
export SENT="$work/sent" PYTHONPATH="$work/packages" PATH="$work/bin:$PATH"

# script TARGET OPTION...: from an empty folder; what it prints goes into `printed`, what arrives into `sent`.
mkdir -p "$work/empty"
script() {
    target=$1
    shift
    : >"$SENT"
    case $target in
    openffboard) runs=sh file=map_upload.sh ;;
    *) runs=python3 file=map_upload.py ;;
    esac
    (cd "$work/empty" && $runs "$work/$target/$file" "$@") >"$work/printed" 2>"$work/stderr" || fail "$target $* ended with an error: $(cat "$work/stderr")"
}
for target in moteus novanta beckhoff openffboard; do
    script $target
    check "$target: something is sent without --store" test ! -s "$SENT"
    check "$target: that nothing was sent is not said" grep -q 'nothing was sent' "$work/printed"
done

script moteus --target 5 --store
{
    printf '5 tel stop\n5 d stop\n'
    grep -v '^#' "$work/moteus/map.cfg" | sed 's/^/5 conf set /'
    echo '5 conf write'
} >"$work/expected"
check "moteus" diff "$work/expected" "$SENT"

script beckhoff --net-id 1.2.3.4.5.6 --address 1002 --channel B --store
grep -v '^#' "$work/beckhoff/map.csv" | awk -F, 'NR > 1 { printf "1.2.3.4.5.6 1002 0x36cb:%s %.6g\n", tolower(substr($2, 3)), $4 }' >"$work/expected"
check "beckhoff" diff "$work/expected" "$SENT"

script novanta --interface eth7 --dictionary drive.xdf --axis 2 --store
{
    printf 'interface eth7\nslave 1 drive.xdf\n'
    grep -v '^#' "$work/novanta/map.csv" | awk -F, 'NR > 1 { printf "2 %d %.6g\n", $1, $2 }'
} >"$work/expected"
check "novanta" diff "$work/expected" "$SENT"
script novanta --interface eth7 --dictionary drive.xdf --read "$work/inside.csv"
check "novanta: reading writes the table" test "$(wc -l <"$SENT")" = 2
run 0 harmonics "$work/inside.csv" --quantity cogging --pole-pairs 2 --torque-constant 0.2 --quiet

script openffboard --store
check "openffboard" grep -qx -- "-c port=SWD -w $work/openffboard/map.hex -v -rst" "$SENT"
finish
