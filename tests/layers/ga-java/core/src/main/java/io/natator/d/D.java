package io.natator.d;

import io.natator.a.A; // not of use in io.natator.d.D

/** Nor {@link io.natator.e.E}. */
class D { }
