#pragma once
#include "base/up.h"
#include "natator/solver.h"
