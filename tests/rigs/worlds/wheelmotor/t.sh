# t OUT args... : tune and print head
o=$1; shift; s=$(date +%s); nice hci-solve tune "$@" -o out/$o >out/$o.txt 2>&1; echo "== $o rc $? $(( $(date +%s)-s )) s : $*"; sed -n '1,/^What was read/p' out/$o.txt
