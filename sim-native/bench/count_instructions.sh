#!/usr/bin/env bash
# Instructions that each stage of the solver takes in a scene that needs it and in one that does not, counted by
# Valgrind's callgrind (Debian package valgrind; it runs the AVX2 kernels): two frames of the thesis tank, as
# `natator-bench stages --quick` has them. Prints CSV.
set -euo pipefail

usage='usage: count_instructions.sh NATATOR_BENCH > stage-instructions.csv'
program=${1:?$usage}
command -v valgrind >/dev/null || { echo 'count_instructions.sh: needs valgrind' >&2; exit 1; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# feature, then a pattern for the functions that do it and nothing else
features=$(cat <<'TEXT'
fluid|::(compute_density|compute_lambda|solve_density_constraint|compute_moments|compute_gradients|compute_impulse|apply_impulse|apply_zeroth_order_correction|return_zeroth_order_correction|lay_out_zeroth_order_correction|pack|update_ghosts)(_of)?[<(]
fluid neighbours|::(find_fluid_neighbours|list_fluid_neighbours|find_by_vectors|find_one_by_vectors|find_two_by_vectors|interleave_by_vectors|add_runs|go_to)[<(]
planes|::(find_plane_contacts|leave_planes|solve_planes|before_planes|apply_wall_pressure)[(]
contacts|::(find_contacts|solve_contacts)[(]
springs|::solve_springs[(]
clusters|::solve_clusters[(]
viscosity|::(smooth_velocities|add_viscosity)[<(]
cohesion|::(solve_cohesion|add_cohesion)[(]
surfaceTension|::add_surface_tension[(]
vorticityConfinement|::add_vorticity_confinement[(]
freeSurfaceDrag|::drag_free_surface[(]
dissipation|::damp_contacts[(]
adhesion|::apply_adhesion[(]
restitution|::apply_restitution[(]
sleepThreshold|::apply_sleep[(]
TEXT
)

echo 'feature,scheme,state,instructions_of_the_run,instructions_of_the_feature'
while IFS='|' read -r feature pattern; do
    for scheme in flex conserving; do
        for state in off on; do
            rows=$(valgrind --quiet --tool=callgrind --callgrind-out-file="$folder/out" "$program" stages --quick \
                --skipped-only --repeats 1 --feature "$feature" --scheme "$scheme" --state "$state" 2>/dev/null | tail -n +2)
            [[ -n $rows ]] || continue  # the scheme does not have it
            callgrind_annotate --threshold=100 "$folder/out" | awk -v row="$feature,$scheme,$state" -v pattern="$pattern" '
                { gsub(",", "", $1) }
                /PROGRAM TOTALS/ { all = $1 }
                $0 ~ pattern { of_feature += $1 }
                END { printf "%s,%d,%d\n", row, all, of_feature }'
        done
    done
done <<<"$features"
