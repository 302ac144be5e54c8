/* Decodes the flash for quick.c (instruction set manual, DS40002198). */
#include <stdlib.h>

#include "quick.h"

enum { WORDS = 0x10002, FLASH_WORDS = 0x4000, SREG = 0x5F };

static uint16_t word_at(const rig_t *rig, unsigned pc) {
    const uint8_t *flash = rig->avr->flash + 2 * pc;
    return (uint16_t)(flash[0] | flash[1] << 8);
}

static bool has_two_words(uint16_t code) {
    return (code & 0xFC0F) == 0x9000 || (code & 0xFE0C) == 0x940C;
}

/* One number: the operation, two registers or a register and a constant, a longer constant. */
static quick_op_t op(unsigned operation, unsigned d, unsigned r, unsigned k) {
    return operation | d << 8 | r << 16 | (quick_op_t)k << 32;
}

static const quick_op_t ASK = OP_ASK;

static quick_op_t decode_two_registers(uint16_t code, unsigned skipped) {
    static const uint8_t OPERATION[16] = {
        [1] = OP_CPC, OP_SBC, OP_ADD, OP_CPSE, OP_CP, OP_SUB,
        OP_ADC, OP_AND, OP_EOR, OP_OR, OP_MOV};
    return op(OPERATION[code >> 10], code >> 4 & 31, (code & 15) | (code >> 5 & 16), skipped);
}

static quick_op_t decode_low(uint16_t code, unsigned skipped) {
    if (code >= 0x0400) return decode_two_registers(code, skipped);
    unsigned d = code >> 4 & 15, r = code & 15;
    switch (code >> 8) {
        case 0: return code ? ASK : op(OP_NOP, 0, 0, 0);
        case 1: return op(OP_MOVW, 2 * d, 2 * r, 0);
        case 2: return op(OP_MULS, 16 + d, 16 + r, 0);
        default: /* the fractional ones of this group are asked for */
            return code & 0x88 ? ASK : op(OP_MULSU, 16 + (d & 7), 16 + (r & 7), 0);
    }
}

static quick_op_t decode_load_or_store(uint16_t code, uint16_t next) {
    unsigned d = code >> 4 & 31;
    bool is_store = code & 0x0200;
    switch (code & 15) {
        case 0:
            if (!is_store && next == R_TCNT1L) return op(OP_LDS_COUNT, d, 0, next);
            if (!is_store && next == R_TCNT1H) return op(OP_LDS_TEMP, d, 0, next);
            if (next < RAM_FIRST || next > RAM_LAST) return ASK;
            return op(is_store ? OP_STS : OP_LDS, d, 0, next);
        case 1: return op(is_store ? OP_ST_PLUS : OP_LD_PLUS, d, ZL, 0);
        case 2: return op(is_store ? OP_ST_MINUS : OP_LD_MINUS, d, ZL, 0);
        case 4: return is_store ? ASK : op(OP_LPM, d, 0, 0);
        case 5: return is_store ? ASK : op(OP_LPM_PLUS, d, 0, 0);
        case 9: return op(is_store ? OP_ST_PLUS : OP_LD_PLUS, d, YL, 0);
        case 10: return op(is_store ? OP_ST_MINUS : OP_LD_MINUS, d, YL, 0);
        case 12: return op(is_store ? OP_STD : OP_LDD, d, XL, 0);
        case 13: return op(is_store ? OP_ST_PLUS : OP_LD_PLUS, d, XL, 0);
        case 14: return op(is_store ? OP_ST_MINUS : OP_LD_MINUS, d, XL, 0);
        case 15: return op(is_store ? OP_PUSH : OP_POP, d, 0, 0);
        default: return ASK;
    }
}

static quick_op_t decode_one_register(uint16_t code, uint16_t next) {
    static const uint8_t OPERATION[11] = {
        OP_COM, OP_NEG, OP_SWAP, OP_INC, OP_ASK, OP_ASR, OP_LSR, OP_ROR, OP_ASK, OP_ASK, OP_DEC};
    if (code == 0x9508) return op(OP_RET, 0, 0, 0);
    if (code == 0x9409) return op(OP_IJMP, 0, 0, 0);
    if (code == 0x9509) return op(OP_ICALL, 0, 0, 0);
    if (code == 0x95C8) return op(OP_LPM, 0, 0, 0);
    if (code == 0x94F8) return op(OP_CLI, 0, 0, 0);
    if (code == 0x9468) return op(OP_SET_T, 0, 0, 0);
    if (code == 0x94E8) return op(OP_CLEAR_T, 0, 0, 0);
    if ((code & 0xFF0F) == 0x9408) return ASK;
    bool is_far = code & 0x01F1 || next >= FLASH_WORDS;
    if ((code & 0xFE0E) == 0x940C) return is_far ? ASK : op(OP_JMP, 0, 0, next);
    if ((code & 0xFE0E) == 0x940E) return is_far ? ASK : op(OP_CALL, 0, 0, next);
    return (code & 15) > 10 ? ASK : op(OPERATION[code & 15], code >> 4 & 31, 0, 0);
}

static quick_op_t decode_port(uint16_t code) {
    unsigned address = 0x20 + ((code & 15) | (code >> 5 & 0x30)), d = code >> 4 & 31;
    bool is_out = code & 0x0800;
    if (address == SREG) return op(is_out ? OP_OUT_SREG : OP_IN_SREG, d, 0, 0);
    if (address == SPL || address == SPH) return op(is_out ? OP_OUT : OP_IN, d, 0, address);
    return ASK;
}

static quick_op_t decode_branch(uint16_t code, unsigned pc, unsigned skipped) {
    unsigned d = code >> 4 & 31, bit = code & 7;
    if (code < 0xF800) {
        int offset = (code >> 3 & 127) - (code & 0x0200 ? 128 : 0);
        unsigned target = pc + 1 + (unsigned)offset;
        unsigned operation = (code & 0x0400 ? OP_BR_NOT_C : OP_BR_C) + bit;
        return target >= FLASH_WORDS ? ASK : op(operation, 0, 0, target);
    }
    if (code & 8) return ASK;
    switch (code >> 9 & 3) {
        case 0: return op(OP_BLD, d, bit, 0);
        case 1: return op(OP_BST, d, bit, 0);
        case 2: return op(OP_SBRC, d, bit, skipped);
        default: return op(OP_SBRS, d, bit, skipped);
    }
}

static quick_op_t decode(const rig_t *rig, unsigned pc) {
    uint16_t code = word_at(rig, pc), next = word_at(rig, pc + 1);
    unsigned skipped = has_two_words(next) ? 2 : 1;
    unsigned high = 16 + (code >> 4 & 15), value = (code & 15) | (code >> 4 & 0xF0);
    unsigned jump = (pc + 1 + (code & 0xFFF) - (code & 0x800 ? 0x1000 : 0)) % FLASH_WORDS;
    switch (code >> 12) {
        case 0: case 1: case 2: return decode_low(code, skipped);
        case 3: return op(OP_CPI, high, value, 0);
        case 4: return op(OP_SBCI, high, value, 0);
        case 5: return op(OP_SUBI, high, value, 0);
        case 6: return op(OP_ORI, high, value, 0);
        case 7: return op(OP_ANDI, high, value, 0);
        case 8: case 10: {
            unsigned offset = (code & 7) | (code >> 7 & 0x18) | (code >> 8 & 0x20);
            unsigned base = code & 8 ? YL : ZL;
            return op(code & 0x0200 ? OP_STD : OP_LDD, code >> 4 & 31, base, offset);
        }
        case 9: break;
        case 11: return decode_port(code);
        case 12: return op(OP_RJMP, 0, 0, jump);
        case 13: return op(OP_RCALL, 0, 0, jump);
        case 14: return op(OP_LDI, high, value, 0);
        default: return decode_branch(code, pc, skipped);
    }
    unsigned pair = 24 + 2 * (code >> 4 & 3), constant = (code & 15) | (code >> 2 & 0x30);
    switch (code >> 8 & 15) {
        case 0: case 1: case 2: case 3: return decode_load_or_store(code, next);
        case 4: case 5: return decode_one_register(code, next);
        case 6: return op(OP_ADIW, pair, constant, 0);
        case 7: return op(OP_SBIW, pair, constant, 0);
        case 8: case 9: case 10: case 11: return ASK;
        default: return op(OP_MUL, code >> 4 & 31, (code & 15) | (code >> 5 & 16), 0);
    }
}

/* Decodes all of it; whatever the program counter can point to beyond is asked for. */
void decode_flash(rig_t *rig) {
    if (!rig->quick) rig->quick = calloc(WORDS, sizeof *rig->quick);
    for (unsigned pc = 0; pc < FLASH_WORDS - 1; pc++) rig->quick[pc] = decode(rig, pc);
    rig->is_decoded = true;
}
