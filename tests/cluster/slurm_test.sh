#!/usr/bin/env bash
# Runs the jobs of examples/slurm for real: starts Debian's munged, slurmctld and slurmd on the loopback interface, with keys,
# sockets and logs in a folder of their own, lets an array of four tasks draw a scene, kills one, submits it again, and
# compares frames and film byte for byte with those of a run that was not shared out. Needs root, because slurmd starts
# processes for others; says why and exits with 77 where it cannot run.
# Usage: slurm_test.sh PROGRAM
set -euo pipefail

program=$(realpath "$1")
examples=$(cd "$(dirname "$0")/../../examples/slurm" && pwd)

skip() { echo "skipped: slurm_tests: $*"; exit 77; }
[ "$(id -u)" -eq 0 ] || skip "slurmd needs root"
for command in munged slurmctld slurmd sbatch squeue scancel; do
    PATH=$PATH:/usr/sbin command -v "$command" >/dev/null || skip "there is no $command (Debian: slurm-wlm, munge)"
done
id munge >/dev/null 2>&1 || skip "there is no user munge"
PATH=$(dirname "$program"):$PATH:/usr/sbin

work=$(mktemp -d)
# Ends what this script has started, by the process numbers that the services left.
stop() {
    local pids pid
    pids=$(cat "$work"/run/{slurmd,slurmctld}.pid "$work"/munge/munged.pid 2>/dev/null) || true
    for pid in $pids; do kill "$pid" 2>/dev/null || true; done
    for pid in $pids; do
        for _ in $(seq 50); do kill -0 "$pid" 2>/dev/null || continue 2; sleep 0.1; done
        kill -9 "$pid" 2>/dev/null || true
    done
    rm -rf "$work"
}
trap stop EXIT
fail() {
    echo "slurm_test: $*" >&2
    tail -n 20 "$work"/run/*.log "$work"/job/*.log >&2 2>/dev/null || true
    exit 1
}

# Waits until a command succeeds. On an idle machine the whole test takes 20 s.
wait_until() { # what for, command...
    local what=$1
    shift
    until "$@"; do
        [ "$SECONDS" -lt 90 ] || fail "$what: not within 90 s; $(squeue 2>&1)"
        sleep 0.05
    done
}
is_idle() { [ "$(sinfo -h -o %t 2>/dev/null)" = idle ]; }
are_done() { [ -z "$(squeue -h -j "$1" 2>/dev/null)" ]; }

# ---- the cluster ----
node=$(hostname)
# A port of loopback that nobody listens on, from a number that differs between runs at the same time.
free_port() {
    local port
    for port in $(seq "$1" $(($1 + 200))); do
        if ! (exec 3<>"/dev/tcp/127.0.0.1/$port") 2>/dev/null; then echo "$port"; return; fi
    done
}
controller_port=$(free_port $((20000 + $$ % 9000)))
node_port=$(free_port $((controller_port + 1)))

chmod 755 "$work"
mkdir "$work"/{munge,run,state,spool,job}
dd if=/dev/urandom of="$work/munge/key" bs=128 count=1 status=none
chown -R munge: "$work/munge"
chmod 400 "$work/munge/key"
cat >"$work/slurm.conf" <<CONFIGURATION
ClusterName=test
SlurmctldHost=$node(127.0.0.1)
SlurmUser=root
AuthType=auth/munge
CryptoType=crypto/munge
AuthInfo=socket=$work/munge/socket
CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
SlurmctldPort=$controller_port
SlurmdPort=$node_port
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
SlurmctldPidFile=$work/run/slurmctld.pid
SlurmdPidFile=$work/run/slurmd.pid
SlurmctldLogFile=$work/run/slurmctld.log
SlurmdLogFile=$work/run/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
MpiDefault=none
ReturnToService=2
SchedulerParameters=batch_sched_delay=0,sched_interval=1
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
NodeName=$node NodeAddr=127.0.0.1 CPUs=2 Boards=1 SocketsPerBoard=1 CoresPerSocket=2 ThreadsPerCore=1 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONFIGURATION
export SLURM_CONF=$work/slurm.conf
# --force: the folder of the socket lies in one that everybody may write to, /tmp.
runuser -u munge -- "$(command -v munged)" --force --num-threads=2 --key-file="$work/munge/key" \
    --socket="$work/munge/socket" --pid-file="$work/munge/munged.pid" --log-file="$work/munge/log" \
    --seed-file="$work/munge/seed" 2>/dev/null || skip "munged does not start: $(tail -n 1 "$work/munge/log")"
slurmctld -f "$SLURM_CONF" || fail "slurmctld does not start"
slurmd -f "$SLURM_CONF" -N "$node" || skip "slurmd does not start: $(tail -n 1 "$work/run/slurmd.log")"
wait_until "the node" is_idle

# ---- the jobs ----
same() { # files that must have the same bytes
    cmp -s "$1" "$2" || fail "$2 differs from $1"
}

scene=$(cd "$(dirname "$0")" && pwd)/drops.toml
job=$work/job
frames=24  # of the scene
drawing=(--size 960x720 --quality final)
cd "$work"
read -r simulate draw film < <("$examples/submit.sh" "$scene" "$job" 4 "${drawing[@]}")

# The third part has frames 2, 6, ..., 22. Its task is killed as soon as it has begun.
wait_until "the third part" test -e "$job/frames/chunk-3-of-4.json"
scancel --signal=KILL --full "${draw}_2" || fail "task 2 had ended before it could be killed"
wait_until "the array and its last job" are_done "$draw,$film"
[ ! -e "$job/film.mp4" ] || fail "there is a film although a task was killed"
grep -q ' of 24 frames of .* are missing: ' "$job/film.log" || fail "the last job does not name what is missing"
missing=$(globular assemble "$job/frames" --print-missing) && fail "nothing is missing although a task was killed"
before=$(stat -c '%n %i' "$job"/frames/frame-000{00,01,03,05}.png)

again=$(sbatch --parsable --output="$job/draw-again.log" --array=2 "$examples/draw.sbatch" "$scene" "$job" 4 \
    "${drawing[@]}")
film=$(sbatch --parsable --output="$job/film.log" --dependency="afterok:$again" "$examples/film.sbatch" "$job")
wait_until "the task submitted again" are_done "$again,$film"
[ -s "$job/film.mp4" ] || fail "there is no film"
[ "$(stat -c '%n %i' "$job"/frames/frame-000{00,01,03,05}.png)" = "$before" ] || fail "whole frames were drawn again"

globular render "$scene" "${drawing[@]}" -o "$work/direct" --video "$work/direct.mp4" --quiet
for frame in $(seq -f frame-%05.0f.png 0 $((frames - 1))); do same "$work/direct/$frame" "$job/frames/$frame"; done
same "$work/direct.mp4" "$job/film.mp4"
echo "an array of four tasks, one of them killed (missing then: $missing) and submitted again: $frames frames and the film" \
    "are those of a run that was not shared out"
