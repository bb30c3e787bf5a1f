#!/bin/bash
# Runs the cases of this sweep with GNU parallel:  parallel.sh [JOBS]
# Given again, it does what is missing. Ctrl-C lets the cases write checkpoints; one of them may take a minute.
seq 1 @CASES@ | parallel --jobs "${1:-$(nproc)}" --termseq TERM,60000,KILL,25 --no-run-if-empty \
  @TALUS@ run @FOLDER@ --case '{}' --quiet
