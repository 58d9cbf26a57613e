#!/bin/bash
# Stands for natator-sim in tests: speaks its protocol, but swims by a formula. The scene says what goes wrong:
# thesis/…, pool/… and plane/loach nothing; fault/NAME the fault below; fault/mixed, fault/idle and fault/chaos one of many faults for
# some ids. Made of shell builtins, so that it starts and answers in a few milliseconds.
here=${0%/*}

# ok ID DISTANCE, by the scheme that $request asks for, else the scene's
ok() {
    local hash digits=${2//[!0-9]/} scheme=flex more=
    if [[ $request = *'"scheme":"conserving"'* || $scene = p[ol]*/* && $request != *'"scheme":"flex"'* ]]; then
        scheme=conserving
        more='"swimming":{"tailAmplitude":0.25,"strouhal":0.3125,"reynolds":131.4,"swimmingNumber":409.6},"work":'$work,
    fi
    printf -v hash '%016x' "$((10#0$digits))"
    printf '{"id":%s,"status":"ok","fitness":%s,"distance":%s,"stopped":"completed","simulated":4.0,"frames":240,"scheme":"%s","precision":"float","hash":"%s",%s"new field":[1]}\n' \
        "$1" "$2" "$2" "$scheme" "$hash" "$more"
}

# The bundled eel's profile.
eel='{"profile":{"length":1.5,"height":[[0,0.18],[0.12,0.3],[0.6,0.3],[1,0.2]],"width":[[0,0.16],[0.15,0.2],[0.6,0.18],[1,0.14]],
"joints":[0.1,0.2,0.3,0.4,0.5,0.6,0.7,0.8,0.9]},"spacing":0.075,"springStiffness":0.4}'

# Sets `distance`: it falls off from an optimum, and is negative far from it. In units of 1e-9. Sets `work`, which grows with the
# first amplitude where there is a file `tired`.
measure() {
    local numbers number exponent whole fraction x sum=800000000 centre=250000000 place=0
    [[ $1 =~ \"gait\":\{([^}]*)\} ]]
    numbers=${BASH_REMATCH[1]//[!0-9.E-]/ }
    for number in $numbers; do
        exponent=0
        if [[ $number = *E-* ]]; then exponent=${number#*E-} number=${number%E*}; fi
        whole=${number%%.*}
        fraction=${number#*.}000000000
        x=$(((whole * 1000000000 + 10#${fraction:0:9}) / 10 ** exponent))
        centre=$((centre + 100000000))
        ((place++ == 1)) && amplitude=$x
        sum=$((sum - (x - centre) * (x - centre) / 1000000000))
    done
    # An evolved body swims far, best at a length of 1.25.
    if [[ $1 =~ \"length\":([0-9.]+) ]]; then
        fraction=${BASH_REMATCH[1]#*.}000000000
        x=$((${BASH_REMATCH[1]%%.*} * 1000000000 + 10#${fraction:0:9} - 1250000000))
        sum=$((sum + 20000000000 - x * x / 1000000000))
    fi
    # Another start: up to 0.05 more or less, otherwise for each gait.
    if [[ $1 =~ \"start\":([0-9]+) ]]; then
        sum=$((sum + ((BASH_REMATCH[1] % 99991 * 7919 + (sum < 0 ? -sum : sum) % 99991 * 31) % 101 - 50) * 1000000))
    fi
    work=0.75
    [[ -e $here/tired ]] && printf -v work '%d.%09d' $((1 + amplitude / 1000000000)) $((amplitude % 1000000000))
    local sign=
    if ((sum < 0)); then sign=- sum=$((-sum)); fi
    printf -v distance '%s%d.%09d' "$sign" $((sum / 1000000000)) $((sum % 1000000000))
}

# Whether this is the first call with this name in this folder.
first() {
    (set -o noclobber && : >"$here/seen-$1") 2>/dev/null
}

# Sets `fault` from a scene and an id.
choose_fault() {
    fault=${1#fault/}
    case $fault in
    mixed)
        case $(($2 % 7)) in
        0) fault=crash ;;
        2) fault=once ;;
        4) fault=half ;;
        *) fault=none ;;
        esac
        ;;
    idle)
        # These cost the caller its time limit and its patience.
        case $2 in
        17) fault=hang ;;
        18) fault=deaf ;;
        *) fault=none ;;
        esac
        ;;
    chaos)
        # Most fail at the first attempt, one in eight of these also at the second.
        local faults=(none crash garbage half exit silent wrong-id nan killed crash half garbage killed)
        fault=${faults[$(($2 * 7919 % 13))]}
        if [[ $fault != none ]]; then
            if first "$2"; then
                : >"$here/fault-$2"
            elif (($2 % 8 != 0)); then
                fault=none
            else
                : >"$here/fault-$2-again"
            fi
        fi
        ;;
    esac
}

# Waits for one of as many turns as the file "turns" says, if there is one.
turn() {
    local turns=0
    while [[ -e $here/turns ]]; do
        { read -r turns <"$here/turns"; } 2>/dev/null
        if ((next_turn >= turns)); then
            sleep 0.01
        elif [[ ! -e $here/seen-turn-$next_turn ]] && first "turn-$next_turn"; then
            return
        else
            ((++next_turn))
        fi
    done
}

# answer REQUEST
answer() {
    local request=$1 id scene
    [[ $request =~ ^\{\"id\":([0-9]+) ]] && id=${BASH_REMATCH[1]}
    [[ $request =~ \"scene\":\"([^\"]*)\" ]] && scene=${BASH_REMATCH[1]}
    [[ -z $slow ]] || sleep "$slow"
    turn
    choose_fault "$scene" "$id"
    measure "$request"
    case $fault in
    crash) kill -SEGV $$ ;;
    killed) kill -KILL $$ ;;
    exit) echo "out of luck" >&2; exit 1 ;;
    silent) exit 0 ;;
    garbage) echo "*** buffer overflow ***" ;;
    half) printf '{"id":%s,"status":"ok","fitn' "$id"; exit 0 ;;
    hang) sleep 3600 ;;
    deaf) exec 1>&-; sleep 3600 ;;
    loud) yes ;;
    loud-line) yes | tr -d '\n' ;;
    loud-errors) yes "a long story" | head -c 3000000 >&2; ok "$id" 0.5 ;;
    wrong-id) ok $((id + 1)) 0.5 ;;
    wrong-exit) ok "$id" 0.5; exit 3 ;;
    nan) ok "$id" NaN ;;
    infinite) ok "$id" 1e999 ;;
    two-lines) ok "$id" "$distance"; ok "$id" "$distance" ;;
    held-open) sleep 3600 & sleep 0.5; ok "$id" 0.5 ;;
    once)
        if first "$id"; then kill -KILL $$; fi
        ok "$id" "$distance"
        ;;
    unstable)
        printf '{"id":%s,"status":"unstable","fitness":0,"distance":null,"stopped":"unstable","simulated":0.5,' "$id"
        printf '"frames":30,"scheme":"flex","precision":"float",'
        printf '"unstable":{"particle":17,"stage":"frame","time":0.5,"law":"tank"}}\n'
        [[ $mode = serve ]] || exit 3
        ;;
    rejected)
        printf '{"id":%s,"status":"error","error":"gait.frequency is 70; expected a number up to 60"}\n' "$id"
        [[ $mode = serve ]] || exit 2
        ;;
    no-device) printf '{"id":%s,"status":"error","error":"no CUDA device"}\n' "$id"; exit 4 ;;
    locked) if ((id == 11)) && first locked; then chmod -x "$0"; fi; ok "$id" "$distance" ;;
    poison) if ((id % 10 == 3)); then kill -KILL $$; else ok "$id" "$distance"; fi ;;
    *) ok "$id" "$distance" ;;
    esac
}

# describe SCENE OVERRIDES; bodies of 1.8 and more it does not take
describe() {
    local actuators goals=
    if [[ $2 =~ \"length\":1\.[89] ]]; then
        echo "natator-sim: creature.profile.length: the body does not fit into the tank" >&2
        exit 2
    fi
    case $1 in
    pool/eel) actuators=8 ;;
    thesis/tank) actuators=0 ;;
    thesis/creature-2 | pool/creature-2) actuators=8 ;;
    thesis/creature-3 | pool/creature-3) actuators=5 ;;
    thesis/* | pool/* | plane/loach | fault/*) actuators=2 ;;
    goals/*) actuators=2 goals=',"goals":["turn"]' ;;
    *)
        echo "natator-sim: scene is \"$1\"; expected a named scene or a file" >&2
        exit 2
        ;;
    esac
    echo "{\"scene\":\"$1\",\"creature\":\"any\",\"actuators\":$actuators,\"particles\":5950,\"duration\":4.0,\"timeStep\":0.016666666666666666,\"substeps\":4,\"iterations\":4,\"bodyLength\":1.2,\"bodyParticles\":142$goals}"
}

mode=$1
next_turn=0
[[ -e $here/slow ]] && slow=$(<"$here/slow")
[[ -e $here/most ]] && most=$(<"$here/most")
case $mode in
info)
    if [[ $2 = --json ]]; then
        echo '{"version":"0.1.0","commit":"0123456789ab","instructionSet":"any","devices":[]}'
    elif [[ $* = *--definition* ]]; then
        if [[ -e $here/scene ]]; then
            cat "$here/scene"
            exit
        fi
        last=${*: -1}
        [[ $2 = pool/eel ]] && creature=",\"creature\":$eel"
        echo "{\"what\":\"$2 ${last//\"/}\"$creature}"
    else
        describe "$2" "${*: -1}"
    fi
    ;;
run)
    # Records nothing.
    if [[ -e $here/no-recording ]]; then
        echo "out of luck" >&2
        exit 1
    fi
    ;;
stream)
    # Says nothing.
    first stream
    sleep 3600
    ;;
converge)
    # Half the spacing takes a tenth of the speed. A file "unstable" makes that level's runs so, "refused" the request.
    if [[ -e $here/refused ]]; then
        echo "natator-sim: request: gait.frequency is 70; expected a number up to 60" >&2
        exit 2
    fi
    echo "natator-sim: converge: base: run 1 of 2, distance 0.5" >&2
    echo "level      substeps" >&2
    finer='"runs":2,"unstable":0,"distance":{"mean":0.45,"error":0.01},"speed":{"mean":0.225,"error":0.005},"change":{"mean":-0.1,"error":0.02}'
    estimate=',"estimate":{"speed":0.2,"error":0.03,"statistical":0.01,"discretisation":0.02}'
    [[ -e $here/unstable ]] && finer='"runs":0,"unstable":2' estimate=
    printf '{"id":0,"scheme":"conserving","bodyLength":1.25,"levels":[{"level":"base","substeps":4,"runs":2,"unstable":0,'
    printf '"distance":{"mean":0.5,"error":0.01},"speed":{"mean":0.25,"error":0.005}},{"level":"spacing/2",%s}]%s}\n' "$finer" "$estimate"
    [[ ! -e $here/unstable ]] || exit 3
    ;;
evaluate)
    IFS= read -r request
    answer "$request"
    ;;
serve)
    if [[ $* = *cuda* ]]; then
        echo "no such device here" >&2
        exit 4
    fi
    [[ ! -e $here/dies-at-start ]] || exit 1
    while IFS= read -r request; do
        # As many answers as the file "most" says; then it waits to be ended.
        [[ -z $most ]] || ((most-- > 0)) || sleep 3600
        answer "$request"
    done
    ;;
esac
