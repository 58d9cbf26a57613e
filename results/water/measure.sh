#!/bin/sh
# Measures all figures of this folder, natator-sim on the PATH; hours on processors, the rest on a GPU. Rows that water.csv holds
# already are kept: in a clone nothing is measured but what another file, given in place of it, does not have.
#
# usage: results/water/measure.sh [FILE]
set -eu
output=${1:-results/water/water.csv}

natator-sim bench water --scheme flex --resolution 20 --output "$output"
natator-sim bench water --scheme conserving --setting 2x4 --resolution 20 --start 1 2 3 4 5 6 7 8 --case vortex stirred-vortex viscous-vortex standing-wave tilted-gravity still-water column couette poiseuille neutral-sphere added-mass heavier-sphere lighter-sphere spinning-sphere slow-sphere towed-sphere towed-cylinder --output "$output"
natator-sim bench water --scheme conserving --setting 1x4 1x6 1x8 --resolution 20 --start 1 2 3 --case vortex stirred-vortex viscous-vortex standing-wave tilted-gravity still-water column couette poiseuille neutral-sphere added-mass heavier-sphere lighter-sphere spinning-sphere slow-sphere towed-sphere --output "$output"
natator-sim bench water --scheme conserving --setting 1x4 --resolution 20 --start 1 2 3 --case towed-cylinder --output "$output"
natator-sim bench water --scheme conserving --setting 1x6 1x8 --resolution 20 --case towed-cylinder --output "$output"
natator-sim bench water --scheme conserving --setting 2x4 --resolution 40 --start 1 2 3 --case vortex stirred-vortex viscous-vortex standing-wave tilted-gravity --output "$output"
natator-sim bench water --scheme conserving --setting 4x4 --resolution 20 --start 1 2 3 --case neutral-sphere added-mass --output "$output"
natator-sim bench water --scheme conserving --setting 4x4 --resolution 40 --start 1 2 --case neutral-sphere added-mass couette poiseuille --output "$output"
natator-sim bench water --scheme conserving --setting 2x4 --resolution 16 --case travelling-wave --output "$output"
natator-sim bench water --scheme conserving --setting 2x4 --resolution 14 --case shedding-cylinder --output "$output"
natator-sim bench water --backend cuda --scheme conserving --setting 2x4 --resolution 20 --start 1 2 3 4 5 --case heavier-sphere lighter-sphere slow-sphere towed-sphere towed-cylinder --output "$output"
natator-sim bench water --backend cuda --scheme conserving --setting 2x4 --resolution 20 --start 4 5 6 7 8 --case travelling-wave shedding-cylinder --output "$output"
natator-sim bench water --backend cuda --scheme conserving --setting 4x4 --resolution 20 --start 1 2 3 --output "$output"
natator-sim bench water --backend cuda --scheme conserving --setting 2x4 --resolution 40 --start 1 2 3 --case vortex stirred-vortex viscous-vortex standing-wave tilted-gravity --output "$output"
natator-sim bench water --backend cuda --scheme conserving --setting 4x4 --resolution 40 --start 1 2 --case vortex stirred-vortex viscous-vortex standing-wave tilted-gravity neutral-sphere added-mass column couette poiseuille heavier-sphere lighter-sphere slow-sphere --output "$output"
natator-sim bench water --backend cuda --scheme conserving --setting 8x4 --resolution 40 --start 1 2 --case spinning-sphere heavier-sphere lighter-sphere --output "$output"
natator-sim bench water --backend cuda --scheme conserving --setting 16x4 --resolution 60 --start 1 2 3 --case neutral-sphere added-mass --output "$output"
natator-sim bench water --backend cuda --scheme conserving --setting 28x4 --resolution 80 --start 1 2 --case added-mass --output "$output"
natator-sim bench water --backend cuda --scheme conserving --setting 4x4 8x4 12x4 16x4 24x4 32x4 48x4 --resolution 40 --start 1 2 3 --case still-water --output "$output"
natator-sim bench water --backend cuda --scheme conserving --setting 8x4 12x4 16x4 24x4 32x4 48x4 --resolution 48 --start 1 2 3 --case still-water --output "$output"
natator-sim bench water --backend cuda --scheme conserving --setting 16x4 24x4 32x4 48x4 --resolution 60 --start 1 2 3 --case still-water --output "$output"
natator-sim bench water --backend cuda --scheme conserving --setting 28x4 32x4 48x4 --resolution 80 --start 1 2 3 --case still-water --output "$output"
natator-sim bench water --backend cuda --scheme conserving --setting 40x4 48x4 --resolution 100 --start 1 2 3 --case still-water --output "$output"
natator-sim bench water --scheme conserving --setting 1x2m 1x4m 2x2m --resolution 20 --start 1 2 3 --case vortex stirred-vortex viscous-vortex standing-wave tilted-gravity still-water column couette poiseuille neutral-sphere added-mass heavier-sphere lighter-sphere spinning-sphere --output "$output"
natator-sim bench water --scheme conserving --setting 1x2m 1x4m 2x2m --resolution 20 --start 1 2 --case towed-sphere --output "$output"
natator-sim bench water --scheme conserving --setting 1x2m 1x4m 2x2m --resolution 20 --case towed-cylinder --output "$output"
natator-sim bench water --scheme conserving --setting 1x2m 2x2m --resolution 20 --case slow-sphere --output "$output"
natator-sim bench water --backend cuda --scheme conserving --setting 1x2m 1x4m 2x2m --resolution 20 28 40 60 80 100 --start 1 2 3 --case still-water --output "$output"
natator-sim bench water --backend cuda --scheme conserving --setting 1x2m 2x2m --resolution 20 40 --start 1 2 3 --case added-mass neutral-sphere column vortex stirred-vortex viscous-vortex standing-wave tilted-gravity --output "$output"
natator-sim bench water --backend cuda --scheme conserving --setting 4x4 --resolution 32 --start 1 2 --case towed-sphere towed-cylinder --output "$output"
natator-sim bench water --backend cuda --scheme conserving --setting 2x4 4x4 --resolution 32 --start 1 2 3 --case shedding-cylinder --output "$output"
natator-sim bench water --backend cuda --scheme conserving --setting 2x4 --resolution 28 --start 1 2 3 --case travelling-wave --output "$output"
natator-sim bench water --scheme conserving --resolution 20 --start 1 2 3 --case vortex --case standing-wave --support 2 --support 2.5 --support 3 --setting 1x2 --setting 1x4 --setting 2x2 --setting 2x4 --setting 2x8 --setting 4x4 --setting 4x8 --setting 8x4 --output "$output"
natator-sim bench water --backend cuda --scheme conserving --setting 2x4 --resolution 20 --start 1 2 3 4 --case tall-cylinder --output "$output"
