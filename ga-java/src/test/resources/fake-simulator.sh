#!/bin/sh
# Stands for natator-sim in tests: speaks its protocol, but swims by a formula. The scene says what goes wrong:
# thesis/… nothing; fault/NAME the fault below; fault/mixed one of many faults for some ids.
here=$(dirname "$0")

# ok ID DISTANCE
ok() {
    printf '{"id":%s,"status":"ok","fitness":%s,"distance":%s,"stopped":"completed","simulated":4.0,"frames":240,' \
        "$1" "$2" "$2"
    printf '"scheme":"flex","precision":"float","hash":"00000000%08x","new field":[1]}\n' "$1"
}

# The distance falls off from an optimum, and is negative far from it.
distance() {
    printf '%s' "$1" | sed 's/.*"gait":{\([^}]*\)}.*/\1/' | tr -c '0-9.E' ' ' | awk '{
        d = 0.8
        for (i = 1; i <= NF; i++) { x = $i - 0.25 - 0.1 * i; d -= x * x }
        printf "%.9f", d
    }'
}

if [ "$1" = info ]; then
    case $2 in
    thesis/creature-2) actuators=8 ;;
    thesis/creature-3) actuators=5 ;;
    thesis/* | fault/*) actuators=2 ;;
    *)
        echo "scene is \"$2\"; expected a named scene or a file" >&2
        exit 2
        ;;
    esac
    echo "{\"scene\":\"$2\",\"creature\":\"any\",\"actuators\":$actuators,\"particles\":5950,\"duration\":4.0}"
    exit 0
fi

scene=
if [ "$1" = evaluate ]; then
    IFS= read -r request
    id=$(printf '%s' "$request" | sed 's/^{"id":\([0-9]*\).*/\1/')
    scene=$(printf '%s' "$request" | sed 's/.*"scene":"\([^"]*\)".*/\1/')
fi

fault=${scene#fault/}
if [ "$fault" = mixed ]; then
    case $((id % 7)) in
    0) fault=crash ;;
    2) fault=once ;;
    4) fault=half ;;
    *) fault=none ;;
    esac
fi

case $fault in
crash) kill -SEGV $$ ;;
exit) echo "out of luck" >&2; exit 1 ;;
silent) exit 0 ;;
garbage) echo "*** buffer overflow ***" ;;
half) printf '{"id":%s,"status":"ok","fitn' "$id" ;;
hang) sleep 60 ;;
loud) yes ;;
loud-errors) yes "a long story" | head -c 3000000 >&2; ok "$id" 0.5 ;;
wrong-id) ok $((id + 1)) 0.5 ;;
wrong-exit) ok "$id" 0.5; exit 3 ;;
nan) ok "$id" NaN ;;
infinite) ok "$id" 1e999 ;;
two-lines) ok "$id" 0.5; ok "$id" 0.5 ;;
held-open) sleep 5 & ok "$id" 0.5 ;;
once)
    # Fails at the first attempt at each id.
    if mkdir "$here/seen-$id" 2>/dev/null; then kill -KILL $$; fi
    ok "$id" "$(distance "$request")"
    ;;
unstable)
    printf '{"id":%s,"status":"unstable","fitness":0,"distance":null,"stopped":"unstable","simulated":0.5,' "$id"
    printf '"frames":30,"scheme":"flex","precision":"float",'
    printf '"unstable":{"particle":17,"stage":"predict","time":0.5}}\n'
    exit 3
    ;;
rejected)
    printf '{"id":%s,"status":"error","error":"gait.frequency is 70; expected a number up to 60"}\n' "$id"
    exit 2
    ;;
no-device) printf '{"id":%s,"status":"error","error":"no CUDA device"}\n' "$id"; exit 4 ;;
*) ok "$id" "$(distance "$request")" ;;
esac
