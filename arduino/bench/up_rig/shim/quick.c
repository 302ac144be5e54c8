/* Instructions that use only registers, RAM and flash, run without simavr.
 *
 * Most instructions are of that kind, and simavr takes long for them, as it must check every
 * address. Here the flash is decoded once (decode.c). Instructions that access a peripheral, enable
 * an interrupt or leave the RAM are left to simavr, which alone runs while the rig measures: both
 * must arrive at the same cycles (tests/arduino/rig/test_quick.py). From the instruction set
 * manual (DS40002198), times of the ATmega328P.
 */
#include "quick.h"

enum { MAX_RUN = 1 << 24 };

void quick_discard(rig_t *rig) { rig->is_decoded = false; }

static inline unsigned pair_at(const uint8_t *data, unsigned at) {
    return data[at] | (unsigned)data[at + 1] << 8;
}

static inline void set_pair(uint8_t *data, unsigned at, unsigned value) {
    data[at] = (uint8_t)value;
    data[at + 1] = (uint8_t)(value >> 8);
}

static inline bool is_ram(unsigned address) {
    return address - RAM_FIRST <= RAM_LAST - RAM_FIRST;
}

static inline bool is_stack(unsigned pointer) { return is_ram(pointer - 2) && is_ram(pointer); }

static inline void push_return(uint8_t *data, unsigned stack, unsigned pc) {
    data[stack] = (uint8_t)pc;
    data[stack - 1] = (uint8_t)(pc >> 8);
    set_pair(data, SPL, stack - 2);
}

/* Flags are kept as the values from which they are computed: the result for Z, bit 7 for N, V and
 * S, bit 4 for H. Most are never used. */
#define ADD_TO(carry) do { \
        unsigned old = D, with = R, sum = old + with + (carry); \
        half = old ^ with ^ sum, over = (old ^ sum) & (with ^ sum); \
        c = sum >> 8, zero = sum & 0xFF, minus = sum, sign = minus ^ over, D = (uint8_t)sum; \
    } while (0)
#define COMPARE(from, with_, carry) \
        unsigned old = (from), with = (with_), rest = old - with - (carry); \
        half = old ^ with ^ rest, over = (old ^ with) & (old ^ rest); \
        c = rest >> 8 & 1, minus = rest, sign = minus ^ over
/* Zero stays only if it was: the result is the higher part of a longer number. */
#define COMPARE_ON(from, with_) COMPARE(from, with_, c); zero |= rest & 0xFF
#define LOGIC(value) do { \
        unsigned result = (value); \
        D = (uint8_t)result, zero = minus = sign = result, over = 0; \
    } while (0)
#define SHIFT(value) do { \
        unsigned old = D, result = (value); \
        c = old & 1, zero = minus = result, over = result ^ c << 7, sign = c << 7; \
        D = (uint8_t)result; \
    } while (0)
#define STEP_BY(one, edge) do { \
        unsigned result = (uint8_t)(D + (one)); \
        zero = minus = result, over = result == (edge) ? 0x80 : 0, sign = minus ^ over; \
        D = (uint8_t)result; \
    } while (0)
#define MULTIPLY(product_) do { \
        unsigned product = (unsigned)(product_) & 0xFFFF; \
        c = product >> 15, zero = product; \
        set_pair(data, 0, product); \
    } while (0)

/* Runs on until a cycle; true when simavr is to run the next instruction before.
 *
 * Each operation must end in a separate jump: one merged by gcc would be mispredicted.
 */
__attribute__((optimize("no-gcse", "no-crossjumping")))
bool quick_run(rig_t *rig, cycle_t end) {
    if (!rig->is_decoded) decode_flash(rig);
#define LABEL(operation) &&DO_##operation,
    static const void *const LABELS[] = {OPERATIONS(LABEL)};
    const quick_op_t *const program = rig->quick;
    avr_t *const avr = rig->avr;
    uint8_t *const data = avr->data, *const flags = avr->sreg;
    const uint8_t *const flash = avr->flash;
    if (avr->cycle >= end) return false;
    const quick_op_t *at = program + avr->pc / 2;
    quick_op_t in;
    unsigned address;
    int left = end - avr->cycle < MAX_RUN ? (int)(end - avr->cycle) : MAX_RUN, all = left;
    bool asks = false;
    unsigned c = flags[S_C], zero = !flags[S_Z], minus = flags[S_N] << 7, over = flags[S_V] << 7;
    unsigned sign = flags[S_S] << 7, half = flags[S_H] << 4, t = flags[S_T], i = flags[S_I];

#define FETCH() do { in = *at; goto *LABELS[in & 0xFF]; } while (0)
#define NEXT(words, cycles) \
    do { at += (words); left -= (int)(cycles); if (left <= 0) goto done; FETCH(); } while (0)
#define PC ((unsigned)(at - program))
#define GO(pc, cycles) do { at = program + (pc); NEXT(0, cycles); } while (0)
#define AT_D (in >> 8 & 0xFF)
#define AT_R (in >> 16 & 0xFF)
#define K ((unsigned)(in >> 32))
#define D data[AT_D]
#define R data[AT_R]
#define NEED(condition) do { if (!(condition)) goto DO_ASK; } while (0)
#define BRANCH(condition) do { if (condition) GO(K, 2); NEXT(1, 1); } while (0)
#define SKIP(condition) do { if (condition) NEXT(1 + K, 1 + K); NEXT(1, 1); } while (0)

    FETCH();
DO_ASK: asks = true; goto done;
DO_NOP: NEXT(1, 1);
DO_MOVW: data[AT_D] = data[AT_R]; data[AT_D + 1] = data[AT_R + 1]; NEXT(1, 1);
DO_MULS: MULTIPLY((int8_t)D * (int8_t)R); NEXT(1, 2);
DO_MULSU: MULTIPLY((int8_t)D * (int)R); NEXT(1, 2);
DO_MUL: MULTIPLY(D * R); NEXT(1, 2);
DO_CPC: { COMPARE_ON(D, R); NEXT(1, 1); }
DO_SBC: { COMPARE_ON(D, R); D = (uint8_t)rest; NEXT(1, 1); }
DO_SBCI: { COMPARE_ON(D, AT_R); D = (uint8_t)rest; NEXT(1, 1); }
DO_CP: { COMPARE(D, R, 0); zero = rest & 0xFF; NEXT(1, 1); }
DO_CPI: { COMPARE(D, AT_R, 0); zero = rest & 0xFF; NEXT(1, 1); }
DO_SUB: { COMPARE(D, R, 0); zero = rest & 0xFF; D = (uint8_t)rest; NEXT(1, 1); }
DO_SUBI: { COMPARE(D, AT_R, 0); zero = rest & 0xFF; D = (uint8_t)rest; NEXT(1, 1); }
DO_NEG: { COMPARE(0, D, 0); zero = rest & 0xFF; D = (uint8_t)rest; NEXT(1, 1); }
DO_ADD: ADD_TO(0); NEXT(1, 1);
DO_ADC: ADD_TO(c); NEXT(1, 1);
DO_AND: LOGIC(D & R); NEXT(1, 1);
DO_EOR: LOGIC(D ^ R); NEXT(1, 1);
DO_OR: LOGIC(D | R); NEXT(1, 1);
DO_ORI: LOGIC(D | AT_R); NEXT(1, 1);
DO_ANDI: LOGIC(D & AT_R); NEXT(1, 1);
DO_COM: LOGIC(D ^ 0xFF); c = 1; NEXT(1, 1);
DO_INC: STEP_BY(1, 0x80); NEXT(1, 1);
DO_DEC: STEP_BY(-1, 0x7F); NEXT(1, 1);
DO_ASR: SHIFT(old >> 1 | (old & 0x80)); NEXT(1, 1);
DO_LSR: SHIFT(old >> 1); NEXT(1, 1);
DO_ROR: SHIFT(old >> 1 | c << 7); NEXT(1, 1);
DO_MOV: D = R; NEXT(1, 1);
DO_LDI: D = (uint8_t)AT_R; NEXT(1, 1);
DO_SWAP: D = (uint8_t)(D << 4 | D >> 4); NEXT(1, 1);
DO_CPSE: SKIP(D == R);
DO_SBRC: SKIP(!(D >> AT_R & 1));
DO_SBRS: SKIP(D >> AT_R & 1);
DO_BLD: D = (uint8_t)((D & ~(1u << AT_R)) | t << AT_R); NEXT(1, 1);
DO_BST: t = D >> AT_R & 1; NEXT(1, 1);
DO_SET_T: t = 1; NEXT(1, 1);
DO_CLEAR_T: t = 0; NEXT(1, 1);
DO_CLI: i = 0; NEXT(1, 1);
DO_LDD:
    address = pair_at(data, AT_R) + K;
    NEED(is_ram(address));
    D = data[address];
    NEXT(1, 2);
DO_STD:
    address = pair_at(data, AT_R) + K;
    NEED(is_ram(address));
    data[address] = D;
    NEXT(1, 2);
DO_LD_PLUS:
    address = pair_at(data, AT_R);
    NEED(is_ram(address));
    set_pair(data, AT_R, address + 1);
    D = data[address];
    NEXT(1, 2);
DO_LD_MINUS:
    address = pair_at(data, AT_R) - 1;
    NEED(is_ram(address));
    set_pair(data, AT_R, address);
    D = data[address];
    NEXT(1, 2);
DO_ST_PLUS:
    address = pair_at(data, AT_R);
    NEED(is_ram(address));
    data[address] = D;
    set_pair(data, AT_R, address + 1);
    NEXT(1, 2);
DO_ST_MINUS:
    address = pair_at(data, AT_R) - 1;
    NEED(is_ram(address));
    data[address] = D;
    set_pair(data, AT_R, address);
    NEXT(1, 2);
DO_LDS: D = data[K]; NEXT(2, 2);
DO_STS: data[K] = D; NEXT(2, 2);
/* Programs that wait read Timer1 all the time; a read changes only TEMP. */
DO_LDS_COUNT: {
    cycle_t now = avr->cycle + (cycle_t)(all - left);
    D = timers_read_count(rig, R_TCNT1L, now + 1);
    NEXT(2, 2);
}
DO_LDS_TEMP: D = rig->temp; NEXT(2, 2);
DO_LPM: D = flash[pair_at(data, ZL)]; NEXT(1, 3);
DO_LPM_PLUS:
    address = pair_at(data, ZL);
    D = flash[address];
    set_pair(data, ZL, address + 1);
    NEXT(1, 3);
DO_PUSH:
    address = pair_at(data, SPL);
    NEED(is_stack(address));
    data[address] = D;
    set_pair(data, SPL, address - 1);
    NEXT(1, 2);
DO_POP:
    address = pair_at(data, SPL) + 1;
    NEED(is_ram(address));
    D = data[address];
    set_pair(data, SPL, address);
    NEXT(1, 2);
DO_JMP: GO(K, 3);
DO_RJMP: GO(K, 2);
DO_IJMP: GO(pair_at(data, ZL), 2);
DO_CALL:
    address = pair_at(data, SPL);
    NEED(is_stack(address));
    push_return(data, address, PC + 2);
    GO(K, 4);
DO_RCALL:
    address = pair_at(data, SPL);
    NEED(is_stack(address));
    push_return(data, address, PC + 1);
    GO(K, 3);
DO_ICALL:
    address = pair_at(data, SPL);
    NEED(is_stack(address));
    push_return(data, address, PC + 1);
    GO(pair_at(data, ZL), 3);
DO_RET:
    address = pair_at(data, SPL);
    NEED(is_ram(address + 1) && is_ram(address + 2));
    set_pair(data, SPL, address + 2);
    GO((unsigned)data[address + 1] << 8 | data[address + 2], 4);
DO_ADIW: {
    unsigned old = pair_at(data, AT_D), sum = old + AT_R;
    set_pair(data, AT_D, sum);
    c = sum >> 16, zero = sum & 0xFFFF, minus = sum >> 8, over = (~old & sum) >> 8;
    sign = minus ^ over;
    NEXT(1, 2);
}
DO_SBIW: {
    unsigned old = pair_at(data, AT_D), rest = old - AT_R;
    set_pair(data, AT_D, rest);
    c = rest >> 16 & 1, zero = rest & 0xFFFF, minus = rest >> 8, over = (old & ~rest) >> 8;
    sign = minus ^ over;
    NEXT(1, 2);
}
DO_IN: D = data[K]; NEXT(1, 1);
DO_OUT: data[K] = D; NEXT(1, 1);
DO_IN_SREG:
    D = (uint8_t)(c | (zero == 0) << 1 | (minus >> 5 & 4) | (over >> 4 & 8) | (sign >> 3 & 16) |
                  (half << 1 & 32) | t << 6 | i << 7);
    NEXT(1, 1);
DO_OUT_SREG: {
    unsigned value = D;
    bool lets_in = !i && value & 0x80;
    NEED(!lets_in || !rig->pending);
    c = value & 1, zero = !(value & 2), minus = value << 5, over = value << 4, sign = value << 3;
    half = value >> 1, t = value >> 6 & 1, i = value >> 7;
    /* One more instruction runs before an interrupt, also before one that is due now. */
    if (lets_in && left <= 1) avr->interrupt_state = -1;
    NEXT(1, 1);
}
DO_BR_C: BRANCH(c);
DO_BR_Z: BRANCH(!zero);
DO_BR_N: BRANCH(minus & 0x80);
DO_BR_V: BRANCH(over & 0x80);
DO_BR_S: BRANCH(sign & 0x80);
DO_BR_H: BRANCH(half & 0x10);
DO_BR_T: BRANCH(t);
DO_BR_I: BRANCH(i);
DO_BR_NOT_C: BRANCH(!c);
DO_BR_NOT_Z: BRANCH(zero);
DO_BR_NOT_N: BRANCH(!(minus & 0x80));
DO_BR_NOT_V: BRANCH(!(over & 0x80));
DO_BR_NOT_S: BRANCH(!(sign & 0x80));
DO_BR_NOT_H: BRANCH(!(half & 0x10));
DO_BR_NOT_T: BRANCH(!t);
DO_BR_NOT_I: BRANCH(!i);

done:
    flags[S_C] = (uint8_t)c, flags[S_Z] = zero == 0, flags[S_N] = minus >> 7 & 1;
    flags[S_V] = over >> 7 & 1, flags[S_S] = sign >> 7 & 1, flags[S_H] = half >> 4 & 1;
    flags[S_T] = (uint8_t)t, flags[S_I] = (uint8_t)i;
    avr->pc = PC * 2;
    avr->cycle += (cycle_t)(all - left);
    return asks;
}
