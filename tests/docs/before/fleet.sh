# A list of motors with their recordings: a few of a line on paper.
"${rig%/*}/motors" 8 1 . || exit 1
