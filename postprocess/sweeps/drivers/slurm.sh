#!/bin/bash
# Runs the cases of this sweep as an array of Slurm:  sbatch slurm.sh
# Given again, or after whatever became of it, it does what is missing; options of sbatch replace those below.
#SBATCH --job-name=@NAME@
#SBATCH --array=1-@TASKS@
#SBATCH --cpus-per-task=@THREADS@
#SBATCH --time=01:00:00
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --output=/dev/null
# Two minutes before the time is up the case writes a checkpoint and stops, and the task queues again to go on.
#SBATCH --signal=B:USR1@120

log=@FOLDER@/drivers/slurm.log
trap 'again=yes; kill -TERM "$case" 2>/dev/null' USR1
trap 'kill -TERM "$case" 2>/dev/null' TERM
worst=0
for ((number = SLURM_ARRAY_TASK_ID; number <= @CASES@; number += @TASKS@)); do
  @TALUS@ run @FOLDER@ --case "$number" --quiet 2>>"$log" &
  case=$!
  wait "$case"
  status=$?
  while kill -0 "$case" 2>/dev/null; do # a signal that was caught ended the wait
    wait "$case"
    status=$?
  done
  if [[ -n $again ]]; then
    echo "case $number goes on after a requeue, from its checkpoint" >>"$log"
    scontrol requeue "${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID"
    exit
  fi
  ((status <= worst)) || worst=$status
done
exit "$worst"
