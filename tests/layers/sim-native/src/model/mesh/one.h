#pragma once
#include "model/tank/two.h"
