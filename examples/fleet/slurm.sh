#!/bin/sh
#SBATCH --job-name=fleet
#SBATCH --array=1-16
#SBATCH --cpus-per-task=1
#SBATCH --requeue
# A batch in shares by a Slurm array: sbatch slurm.sh LIST COMMAND OUT
# One task a share; a task that is requeued goes on. Afterwards: hci-solve fleet OUT/share* -o OUT/line
set -eu
"${HCI_SOLVE:-hci-solve}" batch "$1" --command "$2" --jobs "${SLURM_CPUS_PER_TASK:-1}" --quiet \
    --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT" -o "$3/share$SLURM_ARRAY_TASK_ID" || [ $? -eq 1 ]
