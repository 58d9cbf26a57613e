package io.natator.b;

import static io.natator.c.C.ONE;
