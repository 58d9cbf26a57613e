package io.natator.a;

import io.natator.b.B;
