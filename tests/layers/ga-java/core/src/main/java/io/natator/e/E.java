package io.natator.e;

import io.natator.d.D;
