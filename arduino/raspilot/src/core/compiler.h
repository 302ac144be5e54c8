/** Hints to the chip's compiler that save flash; empty on a PC. */
#pragma once

#ifdef __AVR__
/** One copy, called: where it is inlined or cloned for its object it takes more. */
#define OUT_OF_LINE __attribute__((noinline, noclone))
/**
 * A member that is zero at first. On the chip whatever has such members is static and lies in
 * memory that start-up clears: to clear it member by member takes a kilobyte of flash.
 */
#define ZEROED
/** The same for a base class, before the other initialisers. */
#define ZEROED_BASE(base)
#else
#define OUT_OF_LINE
#define ZEROED = {}
#define ZEROED_BASE(base) base(),
#endif
