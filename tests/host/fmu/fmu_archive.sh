#!/bin/sh
# What an FMU consists of, without another program that imports it: archive, description, sources that any compiler takes,
# and what is said where it cannot be made. Costs 5 seconds of the C compiler.
. "$1/tests/support/common.sh"
machine=$source_dir/data/machine_c
cd "$work" || exit 1
TMPDIR=$work/tmp
export TMPDIR
mkdir "$TMPDIR"

command -v cc >/dev/null || { echo "skipped: no cc"; exit 77; }

run 0 export-fmu "$machine" -q -o c.fmu
check "no temporary file is left" [ -z "$(ls -A "$TMPDIR")" ]
run 0 export-fmu "$machine" --json -o c_again.fmu
check "the same bytes again" cmp c.fmu c_again.fmu
grep -q '"effects":	0' stdout || fail "JSON has no effects"

# ---- the archive, read by another program

python3 - c.fmu <<'END' || fail "the archive"
import sys, zipfile
from xml.etree import ElementTree
archive = zipfile.ZipFile(sys.argv[1])
assert archive.testzip() is None
names = archive.namelist()
assert len(names) == len(set(names))
archive.extractall("fmu")
root = ElementTree.parse("fmu/modelDescription.xml").getroot()
assert root.get("fmiVersion") == "2.0"
model = root.find("CoSimulation")
assert f"binaries/linux64/{model.get('modelIdentifier')}.so" in names
listed = {file.get("name") for file in model.find("SourceFiles")}
assert listed == {name[8:] for name in names if name.startswith("sources/") and name.endswith(".c")}, listed
variables = root.findall("ModelVariables/ScalarVariable")
assert all(v.get("description") for v in variables)
units = {unit.get("name") for unit in root.find("UnitDefinitions")}
reals = [v.find("Real") for v in variables if v.find("Real") is not None]
assert all(real.get("unit") in units for real in reals)
assert {v.get("name") for v in variables if v.get("causality") == "input"} == {"va", "vb", "vc", "load_torque", "speed_prescribed"}
guid = root.get("guid")
assert guid in open("fmu/sources/hci_data.c").read()
END

# ---- its sources: one folder, no options, no warnings

for file in fmu/sources/fmu_*.c fmu/sources/hci_data.c; do
    check "$file compiles" cc -std=c99 -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror -fsyntax-only "$file"
done
nm -D --defined-only fmu/binaries/linux64/machine_c.so | awk '{ print $3 }' >exported
check "only functions of FMI are to be seen" [ -z "$(grep -v '^fmi2' exported)" ]
check "all of them" [ "$(grep -c '^fmi2' exported)" -eq "$(grep -c '^HCI_FMI2_FUNCTION' fmu/sources/fmu_fmi2.h)" ]

# ---- FMI 3, and a controller with its table

run 0 solve "$source_dir/data/machine_a" --target "$source_dir/data/scenarios/02/target.csv" --auto -q -o solved
run 0 export-fmu "$source_dir/data/machine_a" --table solved --drive "$source_dir/data/drive/machine_a_10kHz.csv" --fmi 3 --sources-only --json -q
check "its own name" [ -s machine_a_controller.fmu ]
python3 - machine_a_controller.fmu <<'END' || fail "the archive of FMI 3"
import sys, zipfile
from xml.etree import ElementTree
archive = zipfile.ZipFile(sys.argv[1])
archive.extractall("controller")
root = ElementTree.parse("controller/modelDescription.xml").getroot()
assert root.get("fmiVersion") == "3.0"
build = ElementTree.parse("controller/sources/buildDescription.xml").getroot()
listed = {file.get("name") for file in build.iter("SourceFile")}
assert listed == {name[8:] for name in archive.namelist() if name.startswith("sources/") and name.endswith(".c")}, listed
assert "torque_table.c" in listed and "fmu_machine.c" not in listed
(remedy,) = root.iter("Int32")  # no enumeration: other programs do not know them
assert remedy.get("name") == "remedy" and [remedy.get(word) for word in ("min", "max", "start")] == ["1", "4", "4"]
assert remedy.get("description").endswith("1 table, 2 lead, 3 compensation, 4 feedforward")
assert root.get("instantiationToken") in open("controller/sources/hci_data.c").read()
END
for file in controller/sources/fmu_*.c controller/sources/hci_data.c controller/sources/torque_table.c; do
    check "$file compiles" cc -std=c99 -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror -fsyntax-only "$file"
done

# ---- numbers that are none, and a step in which the control would not see what it does, in a program of its own

(cd controller/sources && cc -std=c99 -O0 -fPIC -shared -o ../controller.so ./*.c -lm) || fail "the controller does not compile"
python3 - <<'END' || fail "numbers that are none"
from ctypes import CDLL, CFUNCTYPE, byref, c_bool, c_char_p, c_double, c_int, c_size_t, c_uint32, c_void_p
from xml.etree import ElementTree
root = ElementTree.parse("controller/modelDescription.xml").getroot()
reference = {v.get("name"): int(v.get("valueReference")) for v in root.find("ModelVariables")}
fmu, said = CDLL("controller/controller.so"), []
log = CFUNCTYPE(None, c_void_p, c_int, c_char_p, c_char_p)(lambda _, status, category, words: said.append((status, category, words)))
make = fmu.fmi3InstantiateCoSimulation
make.restype = c_void_p
one = c_void_p(make(b"one", root.get("instantiationToken").encode(), None, False, True, False, False, None, c_size_t(0), None, log, None))
def value(name):
    out = c_double()
    assert fmu.fmi3GetFloat64(one, byref(c_uint32(reference[name])), c_size_t(1), byref(out), c_size_t(1)) == 0
    return out.value
def put(**values):
    names, count = (c_uint32 * len(values))(*[reference[n] for n in values]), c_size_t(len(values))
    return fmu.fmi3SetFloat64(one, names, count, (c_double * len(values))(*values.values()), count)
def step(duration):
    e, t, r, last = c_bool(), c_bool(), c_bool(), c_double()
    return fmu.fmi3DoStep(one, c_double(value("time")), c_double(duration), False, byref(e), byref(t), byref(r), byref(last))
assert fmu.fmi3EnterInitializationMode(one, False, c_double(), c_double(), False, c_double()) == 0
assert put(torque_reference=1.0, speed=10.0) == 0
assert fmu.fmi3ExitInitializationMode(one) == 0
assert put(ia=0.5, ib=float("nan")) == 2 and said[-1][:2] == (2, b"logStatusDiscard") and b"ib keeps its value" in said[-1][2], said
assert put(angle=float("inf")) == 2
assert value("ia") == 0.0 and value("ib") == 0.0 and abs(value("va")) < 1e3 and step(1e-4) == 0
assert put(ia=1e308, ib=-1e308) == 0
assert fmu.fmi3GetFloat64(one, byref(c_uint32(reference["va"])), c_size_t(1), byref(c_double()), c_size_t(1)) in (0, 3)
assert step(0.5) == 3 and b"a communication step of 0.5 s" in said[-1][2] and b"sample of 0.0001 s" in said[-1][2], said[-1]
state = c_void_p()
assert fmu.fmi3GetFMUState(one, byref(state)) == 0
assert put(ia=0.0, ib=0.0) == 0 and step(1e-4) == 0 and abs(value("time") - 2e-4) < 1e-12
assert fmu.fmi3SetFMUState(one, state) == 0 and abs(value("time") - 1e-4) < 1e-12 and value("ia") == 1e308
END
run 2 export-fmu "$machine" --table solved
grep -q -e '--table needs --drive' stderr || fail "a table without a drive"
run 2 export-fmu "$machine" --table solved --drive drive.csv --inputs currents
run 3 export-fmu "$source_dir/data/machine_a" --table nowhere --drive "$source_dir/data/drive/machine_a_10kHz.csv"

# ---- effects, and what goes wrong

mkdir plain
printf 'name,value,unit,source\npole_pairs,2,1,test\nemf_frequency,50,Hz,test\n' >plain/machine.csv
printf 'order,amplitude_V,phase_rad\n1,21.93,0\n' >plain/back_emf.csv
run 3 export-fmu plain -o plain.fmu
grep -q 'inductance_d' stderr || fail "the missing inductance is not named"
check "nothing is written" [ ! -e plain.fmu ]
run 0 export-fmu plain --inputs currents --sources-only -q -o plain.fmu
CC=no-such-compiler
export CC
run 5 export-fmu "$machine" -o other.fmu
grep -q 'no C compiler: found none named `no-such-compiler`.*--sources-only' stderr || fail "the missing compiler is not named"
CC=false
run 5 export-fmu "$machine" -o other.fmu
grep -q '`false` did not compile' stderr || fail "the compiler's failure is not told"
check "nothing is written" [ ! -e other.fmu ]
check "and nothing left" [ -z "$(ls -A "$TMPDIR")" ]
run 0 export-fmu "$machine" --sources-only -q -o sources.fmu
python3 -c 'import zipfile; assert not [n for n in zipfile.ZipFile("sources.fmu").namelist() if n.startswith("binaries/")]' ||
    fail "--sources-only has a binary"
finish
