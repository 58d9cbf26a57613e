#pragma once
#include "../mesh/one.h"
#include "../plain.h"
