package io.natator.c;

class C { io.natator.a.A.Inner inner; }
