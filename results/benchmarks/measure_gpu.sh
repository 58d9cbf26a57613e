#!/bin/sh
# Measures the GPU's speed: gpu-speed.csv, throughput.csv and throughput-settings.csv, with natator-sim on the PATH and an NVIDIA GPU.
# Rows that these files hold already are kept: in a clone name a folder.
#
# usage: results/benchmarks/measure_gpu.sh [FOLDER]
set -eu
folder=${1:-results/benchmarks}

natator-sim bench speed --backend cuda --scene creature-1 --batch 1 --batch 150 --output "$folder"/gpu-speed.csv
natator-sim bench speed --backend cuda --scheme conserving --scene creature-1 --setting 1x4 1x5 1x6 1x8 2x4 1x2m 1x3m --batch 150 --output "$folder"/gpu-speed.csv
natator-sim bench speed --backend cuda --scheme conserving --scene open-water --batch 1 33 65 130 --output "$folder"/gpu-speed.csv
natator-sim bench speed --backend cuda --scheme conserving --scene vacuum --batch 1 150 --output "$folder"/gpu-speed.csv
natator-sim bench speed --backend cuda --scheme flex --scene creature-1 --batch 1 --whole-gpu --output "$folder"/gpu-speed.csv
natator-sim bench speed --backend cuda --scene fluid-x8 --batch 1 --batch 4 --batch 16 --output "$folder"/gpu-speed.csv
natator-sim bench speed --backend cuda --scene fluid-x64 --batch 1 --output "$folder"/gpu-speed.csv
natator-sim bench throughput --scheme flex --repeats 2 --particles 1000 --particles 2000 --particles 4000 --particles 5660 --particles 8000 --particles 16000 --particles 19000 --particles 22000 --particles 32000 --particles 47000 --particles 64000 --particles 128000 --batch 1 --batch 4 --batch 16 --batch 64 --batch 150 --output "$folder"/throughput.csv
natator-sim bench throughput --scheme flex --repeats 2 --particles 380000 --particles 1000000 --particles 10000000 --batch 1 --output "$folder"/throughput.csv
natator-sim bench throughput --scheme conserving --repeats 1 --particles 1000 --particles 5600 --particles 16000 --particles 47000 --particles 128000 --particles 380000 --particles 1000000 --batch 1 --batch 16 --batch 150 --output "$folder"/throughput.csv
natator-sim bench throughput --scheme conserving --repeats 1 --particles 10000000 --batch 1 --output "$folder"/throughput.csv
natator-sim bench throughput --scheme conserving --repeats 1 --particles 47000 380000 1000000 10000000 --batch 1 --without-lists --output "$folder"/throughput.csv
natator-sim bench throughput --scheme conserving --particles 380000 --setting 2x4 2x6 2x8 4x4 1x9 --batch 1 --output "$folder"/throughput-settings.csv
natator-sim bench throughput --scheme conserving --particles 380000 1000000 10000000 --setting 1x2m 1x3m 1x4m 2x2m --batch 1 --repeats 1 --output "$folder"/throughput-settings.csv
