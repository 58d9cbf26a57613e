#pragma once

/// @mainpage
/// All of the library. A program begins with load_scene.h or scene.h, what is simulated; simulation.h, a run frame by
/// frame; evaluate.h, a whole run of a gait, and batch.h, many of them on a GPU.
#include "natator/batch.h"
#include "natator/cost.h"
#include "natator/error.h"
#include "natator/evaluate.h"
#include "natator/gait.h"
#include "natator/instruction_set.h"
#include "natator/limits.h"
#include "natator/load_scene.h"
#include "natator/measure.h"
#include "natator/model.h"
#include "natator/record.h"
#include "natator/scene.h"
#include "natator/settled_state_cache.h"
#include "natator/simulation.h"
#include "natator/solver.h"
#include "natator/version.h"

/// Simulates swimming creatures. Units are those of the scene: length, second, mass.
namespace natator {}
