#!/usr/bin/env bash
# Runs globular-mpi with mpirun and compares every file with those of `globular simulate`, byte for byte: scenes, steppers and
# formats on 1 to 6 ranks, with and without balancing; runs that are resumed on other numbers of ranks, killed, interrupted,
# unstable or given wrong input. Says why and exits with 77 where Open MPI's mpirun is missing.
# Usage: ranks_test.sh PROGRAM MPI_PROGRAM [--all]; --all compares every run on every number of ranks, which takes minutes
set -euo pipefail

globular=$(realpath "$1")
globular_mpi=$(realpath "$2")
all=
[ "${3:-}" != --all ] || all="1 1- 2 2- 3 3- 4 4- 6 6-"
mixture=$(realpath "$(dirname "$0")/mixture.toml")
{ mpirun --version 2>/dev/null || true; } | grep -q 'Open MPI' ||
    { echo "skipped: mpi_tests: there is no mpirun of Open MPI (Debian: openmpi-bin)"; exit 77; }

# More ranks than processors, as root, in a container without the right to read another process's memory.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_mpi_yield_when_idle=1 OMPI_MCA_hwloc_base_binding_policy=none
export OMPI_MCA_btl=self,vader OMPI_MCA_btl_vader_single_copy_mechanism=none

work=$(mktemp -d)
running=  # mpirun in the background, while there is one
clean_up() {
    [ -z "$running" ] || kill "$running" 2>/dev/null || true
    rm -rf "$work"
}
trap clean_up EXIT
fail() {
    echo "ranks_test: $*" >&2
    exit 1
}
cd "$work"
exec </dev/null
cp "$mixture" .

seldom=(--checkpoint 1000)  # so that there is one at the end only, the same in every run
alone() { "$globular" simulate --quiet "${seldom[@]}" "$@"; }
on_ranks() { # number of ranks, arguments of simulate...
    local count=$1
    shift
    timeout --kill-after=5 60 mpirun -np "$count" "$globular_mpi" simulate --quiet "${seldom[@]}" "$@"
}

# A report without the lines that say how the run was computed, not what it gave.
report_of() { grep -v -E '^ *"(threads|simulating|encoding|all|resumed_from)": ' "$1/run.json"; }

same_run() { # folders of the same run, what the second one is
    { diff -rq --exclude run.json "$1" "$2" && diff <(report_of "$1") <(report_of "$2"); } >differences ||
        fail "$3: $(head -n 5 differences)"
}

# ---- scenes, steppers, ranks ----
compared=0
# Numbers of ranks that end in - are without balancing.
compare() { # arguments of simulate in one string, numbers of ranks...
    local arguments=$1 ranks flags
    shift
    rm -rf one
    alone $arguments -o one
    for ranks in ${all:-"$@"}; do
        flags=
        [[ $ranks != *- ]] || flags=--no-balance
        rm -rf several
        on_ranks "${ranks%-}" $arguments $flags -o several || fail "$arguments on $ranks ranks ended with $?"
        same_run one several "$arguments on $ranks ranks"
        compared=$((compared + 1))
    done
}
fixed() { echo "--set physics.stepper=$1 --set physics.step=$2"; }

compare "figure-1 --frames 0-15" 1 6-
compare "figure-1 --frames 0-15 $(fixed leapfrog 0.01)" 3
compare "measured/powder --frames 0-8" 4- 2
compare "measured/powder --frames 0-8 $(fixed velocity-verlet 0.004)" 6 1-
compare "measured/cascade --frames 0-6" 3-
compare "measured/cascade --frames 0-6 $(fixed symplectic-euler 0.002) --threads 2" 4
compare "measured/liquid --frames 0-2 --set resolution=0.5" 2- 6
compare "measured/liquid --frames 0-3 --set resolution=0.5 $(fixed leapfrog 0.004)" 3
compare "measured/liquid --frames 0-1 --set resolution=0.5 $(fixed implicit-damping 0.01)" 4
compare "measured/honey --frames 0-4 --set resolution=0.8 $(fixed linearly-implicit 0.01)" 2
compare "measured/honey --frames 0-6" 3
compare "measured/fountain --frames 0-72" 2  # long enough for the last frame to have an old neighbor list
compare "mixture.toml --set physics.precision=float" 3
compare "mixture.toml $(fixed velocity-verlet 0.002) --format ply,vtp,lammps,extxyz" 4- 2
grep -q '"deaths": [1-9]' one/run.json || fail "no particle has left the world of mixture.toml"
echo "$compared runs on several ranks have every byte of the same run in one process"

# ---- checkpoints: four ranks, then two, then none ----
rm -rf one several
part() { # last frame, number of ranks or 0 for none, options...
    local run=(measured/cascade --frames "0-$1" "${@:3}")
    alone "${run[@]}" -o one
    if [ "$2" -eq 0 ]; then alone "${run[@]}" -o several; else on_ranks "$2" "${run[@]}" -o several; fi
    same_run one several "cascade up to frame $1"
}
part 4 4
part 8 2 --resume
part 12 0 --resume
# A run that was not disturbed, and one that was: the frames, the last state, and what the reports say.
same_outcome() { # folders, what the second one is
    local file
    for file in "$1"/particles-*.ply "$1"/checkpoint-*.state; do cmp -s "$file" "$2/${file##*/}" || fail "$3: ${file##*/} differs"; done
    diff <(report_of "$1") <(report_of "$2") >differences || fail "$3: $(head -n 5 differences)"
    if ls -A "$2" | grep -v -x -E '(particles-[0-9]+\.ply|checkpoint-[0-9]+\.state|manifest\.json|run\.json)'; then
        fail "$3 left something behind"
    fi
}
alone measured/cascade --frames 0-12 -o whole
same_outcome whole several "cascade on 4 ranks, then 2, then none"
echo "a run on 4 ranks, resumed on 2 and then without MPI, has every byte of an undisturbed run, checkpoints included"

# ---- ranks that are killed, and Ctrl-C ----
scene=measured/fountain
rm -rf whole several
frames_in() { find "$1" -name 'particles-*.ply' | wc -l; }
# Starts a run in the background that has far to go, and waits until it has made some frames.
begin() { # options...
    local wanted=4
    [ ! -d several ] || wanted=$(($(frames_in several) + 3))
    mpirun -np 3 "$globular_mpi" simulate --quiet --checkpoint 0.1 $scene "$@" -o several 2>log &
    running=$!
    until [ -d several ] && [ "$(frames_in several)" -ge $wanted ]; do
        kill -0 $running 2>/dev/null || fail "mpirun ended before it had made $wanted frames: $(cat log)"
        sleep 0.02
    done
}
# Waits for a run that was disturbed, keeps a copy of its frames, and sets the status that mpirun ended with.
finish() { # name of the copy
    local deadline=$((SECONDS + 20))
    while kill -0 $running 2>/dev/null; do
        [ $SECONDS -lt $deadline ] || fail "$1: mpirun goes on for 20 s"
        sleep 0.05
    done
    status=0
    wait $running || status=$?
    running=
    [ $status -ne 0 ] || fail "$1: mpirun ended with 0"
    mkdir "$1"
    cp several/particles-*.ply "$1"
}
kill_rank() { # rank
    local process
    for process in $(cat /proc/$running/task/*/children); do
        if tr '\0' '\n' <"/proc/$process/environ" | grep -q -x "OMPI_COMM_WORLD_RANK=$1"; then
            kill -KILL "$process"
            return
        fi
    done
    fail "there is no rank $1"
}
begin
kill -INT $running
finish interrupted
grep -q '^error: interrupted after ' log || fail "Ctrl-C: the run did not end in order: $(cat log)"
grep -q '"interrupted": true' several/run.json || fail "Ctrl-C: run.json does not say so"
of_interrupted=$status
begin --resume
kill_rank 2
finish killed
of_killed=$status
begin --resume
kill_rank 0
finish killed-first
last=$(($(frames_in several) + 2))
on_ranks 2 $scene --frames 0-$last --resume -o several
alone $scene --frames 0-$last -o whole
for frame in interrupted/* killed/* killed-first/*; do cmp -s "$frame" "whole/${frame##*/}" || fail "$frame is not whole"; done
same_outcome whole several "a run that was interrupted and killed twice"
echo "Ctrl-C (mpirun: $of_interrupted), a killed rank (mpirun: $of_killed), rank 0 killed (mpirun: $status): every file was" \
    "whole, and $((last + 1)) frames of the resumed run have the bytes of an undisturbed one"

# ---- what cannot be run ----
errors_of() { grep '^error: ' "$1"; }
# Both programs must end alike, with the same lines of errors, but for the name of the program.
refuse() { # exit status, arguments of simulate...
    local wanted=$1 code=0
    shift
    rm -rf one several
    alone "$@" -o one 2>one.log || code=$?
    [ $code -eq "$wanted" ] || fail "$*: globular ends with $code, not with $wanted: $(cat one.log)"
    code=0
    on_ranks 3 "$@" -o several 2>several.log || code=$?
    [ $code -eq "$wanted" ] || fail "$*: mpirun ends with $code, not with $wanted: $(cat several.log)"
    diff <(errors_of one.log) <(errors_of several.log | sed 's/globular-mpi/globular/g') ||
        fail "$*: other errors than those of globular"
}
printf 'title = "wrong"\nduration = -1\nfsp = 25\n[[body]]\nshape = "ball"\nradius = 1\ncenter = [0, 0, 0]\n' >wrong.toml
refuse 2 wrong.toml
refuse 2 missing.toml
refuse 2 measured/powder --nope
code=0
on_ranks 3 - -o several <mixture.toml 2>several.log || code=$?
[ "$code $(errors_of several.log | wc -l)" = "2 1" ] || fail "standard input: status $code, $(cat several.log)"
code=0
on_ranks 2 measured/powder --set 'physics.forces="reference"' -o several 2>several.log || code=$?
[ "$code $(errors_of several.log | wc -l)" = "2 1" ] || fail "every pair on ranks: status $code, $(cat several.log)"
mkdir first second
cp mixture.toml first
sed 's/^seed = 3/seed = 4/' mixture.toml >second/mixture.toml
run=("$globular_mpi" simulate mixture.toml -o states)
code=0
timeout --kill-after=5 60 mpirun -np 1 -wdir "$work/first" "${run[@]}" : -np 1 -wdir "$work/second" "${run[@]}" 2>log || code=$?
[ "$code $(grep -c '^error: rank 1: the scene differs ' log)" = "1 1" ] || fail "two scenes: status $code, $(cat log)"
refuse 3 measured/powder --frames 0-40 --set 'material[0].b1=1e12' $(fixed symplectic-euler 0.01) --set physics.wall=paper
same_run one several "a run that became unstable"
echo "wrong input and an unstable run end with the errors and exit statuses of globular"
