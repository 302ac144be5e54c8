/* The instructions that quick.c runs without simavr, decoded by decode.c from the flash. */
#pragma once

#include "rig.h"

enum { RAM_FIRST = 0x100, RAM_LAST = 0x8FF, SPL = 0x5D, SPH = 0x5E };
enum { XL = 26, YL = 28, ZL = 30 };

/* ASK is left to simavr. The branches stand in the order of the flags. */
#define OPERATIONS(DO) \
    DO(ASK) DO(NOP) DO(MOVW) DO(MULS) DO(MULSU) DO(MUL) DO(CPC) DO(SBC) DO(ADD) DO(CPSE) DO(CP) \
    DO(SUB) DO(ADC) DO(AND) DO(EOR) DO(OR) DO(MOV) DO(CPI) DO(SBCI) DO(SUBI) DO(ORI) DO(ANDI) \
    DO(LDD) DO(STD) DO(LD_PLUS) DO(LD_MINUS) DO(ST_PLUS) DO(ST_MINUS) DO(LDS) DO(STS) DO(LPM) \
    DO(LDS_COUNT) DO(LDS_TEMP) DO(LPM_PLUS) DO(PUSH) DO(POP) DO(COM) DO(NEG) DO(SWAP) DO(INC) \
    DO(ASR) DO(LSR) DO(ROR) DO(DEC) DO(CLI) DO(SET_T) DO(CLEAR_T) DO(RET) DO(IJMP) DO(ICALL) \
    DO(JMP) DO(RJMP) DO(CALL) DO(RCALL) DO(ADIW) DO(SBIW) DO(IN) DO(IN_SREG) DO(OUT) DO(OUT_SREG) \
    DO(LDI) DO(BLD) DO(BST) DO(SBRC) DO(SBRS) \
    DO(BR_C) DO(BR_Z) DO(BR_N) DO(BR_V) DO(BR_S) DO(BR_H) DO(BR_T) DO(BR_I) \
    DO(BR_NOT_C) DO(BR_NOT_Z) DO(BR_NOT_N) DO(BR_NOT_V) DO(BR_NOT_S) DO(BR_NOT_H) DO(BR_NOT_T) \
    DO(BR_NOT_I)

#define NAME(operation) OP_##operation,
enum { OPERATIONS(NAME) };

void decode_flash(rig_t *rig);
