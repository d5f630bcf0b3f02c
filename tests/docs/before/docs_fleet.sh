# The motors of docs/fleet.md: a few of a line on paper, with their recordings.
# Called in a scratch folder with the data of the project.
"${rig%/*}/motors" 8 1 . || exit 1
