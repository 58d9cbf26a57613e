#pragma once
#include "model/plain.h"
