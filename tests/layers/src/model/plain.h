#pragma once
#include "natator/solver.h"
#include "base/up.h"
