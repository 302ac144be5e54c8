/* An ATmega328P on a bench: simavr decodes the instructions, everything else is modelled here.
 *
 * simavr's peripherals are not exact where this project measures (see core.c), so that the core's
 * register hooks are replaced by those of the files beside this one, written from the data sheet
 * (ATmega48A/PA/88A/PA/168A/PA/328/P, DS40002061B; section numbers in the comments).
 * All times are cycles of 62.5 ns since the bench was made; they never stop or wrap, no matter how
 * often the chip is reset.
 */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <simavr/sim_avr.h>

typedef uint64_t cycle_t;
#define NEVER UINT64_MAX
#define CYCLES_PER_US 16

/* Registers, as addresses in data space. */
enum {
    R_PINB = 0x23, R_DDRB, R_PORTB, R_PINC, R_DDRC, R_PORTC, R_PIND, R_DDRD, R_PORTD,
    R_TIFR0 = 0x35, R_TIFR1, R_TIFR2,
    R_PCIFR = 0x3B, R_EIFR, R_EIMSK,
    R_EECR = 0x3F, R_EEDR, R_EEARL, R_EEARH, R_GTCCR,
    R_TCCR0A = 0x44, R_TCCR0B, R_TCNT0, R_OCR0A, R_OCR0B,
    R_MCUSR = 0x54, R_MCUCR, R_SPMCSR = 0x57,
    R_WDTCSR = 0x60,
    R_PCICR = 0x68, R_PCMSK0 = 0x6B, R_PCMSK1, R_PCMSK2, R_TIMSK0, R_TIMSK1, R_TIMSK2,
    R_ADCL = 0x78, R_ADCH, R_ADCSRA, R_ADCSRB, R_ADMUX,
    R_TCCR1A = 0x80, R_TCCR1B, R_TCCR1C, R_TCNT1L = 0x84, R_TCNT1H,
    R_OCR1AL = 0x88, R_OCR1AH, R_OCR1BL, R_OCR1BH,
    R_TCCR2A = 0xB0, R_TCCR2B, R_TCNT2, R_OCR2A, R_OCR2B,
    R_TWBR = 0xB8, R_TWSR, R_TWAR, R_TWDR, R_TWCR,
    R_UCSR0A = 0xC0, R_UCSR0B, R_UCSR0C, R_UBRR0L = 0xC4, R_UBRR0H, R_UDR0,
};

enum { VECTORS = 26, PORTS = 3, TIMERS = 3 };
enum { RESET_POWER = 1, RESET_EXTERNAL = 2, RESET_BROWN_OUT = 4, RESET_WATCHDOG = 8 };

typedef struct rig rig_t;

/* ---- records for the caller ---- */
typedef struct { cycle_t cycle; uint8_t pin, level; } edge_t;
typedef struct { cycle_t cycle; uint8_t value; } sent_t;
typedef struct { cycle_t rise, fall; } pulse_t; /* fall is 0 before the first has ended */
typedef struct { void *items; size_t count, room; } record_t;

void record_add(record_t *record, const void *item, size_t size);

/* ---- a queue of things that are to happen at a cycle ---- */
typedef struct { cycle_t cycle; uint64_t order; uint8_t kind, a, b; } event_t;
enum { EVENT_PIN, EVENT_PIN_FLAG };
typedef struct { event_t *items; size_t count, room; uint64_t order; } queue_t;

void queue_add(queue_t *queue, cycle_t cycle, uint8_t kind, uint8_t a, uint8_t b);
event_t queue_take(queue_t *queue);

/* ---- parts ---- */
typedef struct {
    uint8_t driven, drive;   /* which pins are driven from outside, and how */
    uint8_t level;           /* what PIN shows */
    uint8_t line;            /* what a servo at the pin sees: low unless the chip drives it high */
    uint8_t override, latch; /* pins that a timer has, and the level of its latch */
} port_t;

typedef struct {
    uint8_t number;
    uint16_t mask;        /* 0xFF or 0xFFFF */
    uint32_t divider;     /* cycles of a tick; 0 while stopped */
    uint16_t value;       /* count at `origin` */
    cycle_t origin;       /* a tick's edge */
    uint16_t compare[2];
    cycle_t blocked;      /* the tick at which no match may be seen after a write of the count */
    cycle_t due[3];       /* compare A, compare B, overflow */
} rig_timer_t;

typedef struct {
    uint8_t buffer[3], errors[3]; /* two bytes and the shift register */
    uint8_t count;
    uint8_t waiting;              /* UDR's byte for the transmitter */
    bool is_waiting, is_sending;
    uint8_t sending;
    cycle_t send_end;
    double line_bit;              /* cycles of a bit, as the other side sends */
    double line_free;
    struct { uint8_t value, flags; double start; } *line;
    size_t line_first, line_count, line_room;
    cycle_t due;                  /* arrival of the line's first byte */
    uint64_t overruns;
} uart_t;

enum { IMU_OK, IMU_NACK, IMU_SDA_LOW, IMU_SCL_LOW, IMU_RELEASES_AFTER_CLOCKS };

/* Requests a new sample: temperature is out[3], the order is that of the registers. */
typedef void (*imu_sample_t)(cycle_t cycle, int16_t *out);

typedef struct {
    uint8_t registers[128];
    uint8_t shadow[14];       /* what a burst sees */
    uint8_t pointer;
    bool has_pointer;
    uint8_t address, identity;
    bool is_present;
    cycle_t ready;            /* NACKs until then */
    cycle_t sampled, epoch;
    imu_sample_t sample;
    uint8_t state, fault;     /* planned fault, present fault */
    uint32_t fault_after;     /* bytes of a transfer, its address is byte 0 */
    uint32_t fault_transfers; /* transfers left before it may begin */
    uint32_t transfer_bytes;
    uint8_t clocks_left;
    uint64_t samples, transfers;
} imu_t;

typedef struct {
    enum { TWI_IDLE, TWI_STARTED, TWI_WRITING, TWI_READING, TWI_FOREIGN } state;
    enum { DO_NOTHING, DO_START, DO_ADDRESS, DO_WRITE, DO_READ, DO_STOP } doing;
    cycle_t due;
    uint8_t byte;
    bool is_waiting;          /* for a bus that is held */
    cycle_t free_at;
} twi_t;

typedef struct {
    uint8_t cells[1024];
    cycle_t master_until, done;
    uint16_t address;
    uint8_t value, mode;
    uint64_t writes;
} eeprom_t;

typedef struct { cycle_t change_until, due; double factor; } watchdog_t;

typedef struct {
    uint32_t pins_uv[8];
    cycle_t hold, done;       /* of the present conversion, NEVER without one */
    uint16_t held;
    bool is_locked;           /* ADCL was read, ADCH not yet */
} adc_t;

typedef struct {
    uint64_t interrupt_cycles;          /* from an interrupt's entry to its RETI */
    uint64_t counts[VECTORS];
    uint32_t longest_off;               /* longest time with interrupts off */
    uint16_t longest_off_pc;
    uint64_t sleep_cycles;
    uint16_t stack_lowest;
    uint64_t resets[4];                 /* power, external, brown-out, watchdog */
} meter_t;

/* An instruction as decode.c has read it. */
typedef uint64_t quick_op_t;

struct rig {
    avr_t *avr;
    quick_op_t *quick;       /* of each word that the program counter can point to */
    bool is_decoded;         /* it matches the present flash */
    const char *crash_code;  /* why the chip stopped, permanently; NULL while it runs */
    char crash_text[96];
    cycle_t next_due;
    bool is_planned;
    bool is_measuring;       /* interrupts off and stack: needs one instruction at a time */
    queue_t queue;
    uint32_t pending;        /* bit of each vector whose flag and mask are set */
    port_t ports[PORTS];
    rig_timer_t timers[TIMERS];
    cycle_t prescaler_zero[2]; /* timers 0 and 1, timer 2 */
    uint8_t temp;            /* the 16 bit registers' high byte */
    uart_t uart;
    twi_t twi;
    imu_t imu;
    eeprom_t eeprom;
    watchdog_t watchdog;
    adc_t adc;
    meter_t meter;
    record_t edges, sent;
    bool drops_edges;        /* unused by the caller: only the newest pulses are kept */
    cycle_t rises[8 * PORTS];
    pulse_t pulses[8 * PORTS];
    uint8_t reset_wanted;    /* its cause, 0 for none */
    cycle_t reset_until;
    cycle_t start_up;        /* length of a reset, the fuses' SUT */
    uint8_t depth;           /* of nested interrupts */
    cycle_t entered;         /* when the outermost of them began */
    cycle_t off_since;
    uint16_t off_pc;
    uint32_t break_pc;       /* where `on_break` writes, UINT32_MAX for nowhere */
    struct { uint16_t address, size; uint8_t bytes[64]; } preloads[16];
    uint8_t preload_count;
    uint32_t random;
};

/* ---- core.c ---- */
cycle_t read_time(const rig_t *rig);   /* of the register access that is being made */
cycle_t write_time(const rig_t *rig);
uint8_t bits_written(const rig_t *rig, uint8_t value); /* SBI writes one bit alone */
void run_events(rig_t *rig, cycle_t now);
void replan(rig_t *rig);
void want_reset(rig_t *rig, uint8_t cause);
void note_crash(rig_t *rig, const char *code, const char *format, unsigned value);
uint32_t next_random(rig_t *rig);
void hook_read(rig_t *rig, uint16_t address, avr_io_read_t function);
void hook_write(rig_t *rig, uint16_t address, avr_io_write_t function);
uint8_t read_register(avr_t *avr, avr_io_addr_t address, void *param); /* as it is by then */

/* ---- quick.c ---- */
bool quick_run(rig_t *rig, cycle_t end);
void quick_discard(rig_t *rig);

/* ---- interrupts.c ---- */
void interrupts_hook(rig_t *rig);
void interrupts_refresh(rig_t *rig);
void set_flag(rig_t *rig, uint16_t address, uint8_t bits);
void interrupt_enter(rig_t *rig);
void interrupt_leave(rig_t *rig);

/* ---- the parts ---- */
void ports_hook(rig_t *rig);
void ports_reset(rig_t *rig, cycle_t now);
void port_drive(rig_t *rig, uint8_t pin, uint8_t how, cycle_t now); /* 0, 1, or 2: release */
void port_update(rig_t *rig, uint8_t port, cycle_t now);
void port_take(rig_t *rig, uint8_t pin, bool is_taken, bool latch, cycle_t now);
void pin_flag(rig_t *rig, uint8_t port);

void timers_hook(rig_t *rig);
void timers_reset(rig_t *rig, cycle_t now);
cycle_t timers_due(const rig_t *rig);
void timers_run(rig_t *rig, cycle_t now);
uint8_t timers_read_count(rig_t *rig, uint16_t address, cycle_t when);

void uart_hook(rig_t *rig);
void uart_reset(rig_t *rig);
cycle_t uart_due(const rig_t *rig);
void uart_run(rig_t *rig, cycle_t now);

void twi_hook(rig_t *rig);
void twi_reset(rig_t *rig);
void twi_bus_changed(rig_t *rig, cycle_t now);
void twi_gpio_clock(rig_t *rig, cycle_t now);
bool twi_has_pins(const rig_t *rig);
void twi_run(rig_t *rig, cycle_t now);

void imu_power_on(rig_t *rig, cycle_t now);
void imu_start(rig_t *rig);
bool imu_address(rig_t *rig, uint8_t byte, cycle_t now);
bool imu_write(rig_t *rig, uint8_t byte, cycle_t now);
uint8_t imu_read(rig_t *rig, cycle_t now);
bool imu_holds_sda(const rig_t *rig);
bool imu_holds_scl(const rig_t *rig);

void eeprom_hook(rig_t *rig);
void eeprom_reset(rig_t *rig);
void eeprom_run(rig_t *rig, cycle_t now);
void eeprom_power_cut(rig_t *rig, cycle_t now);

void adc_hook(rig_t *rig);
void adc_reset(rig_t *rig);

void watchdog_hook(rig_t *rig);
void watchdog_reset(rig_t *rig, cycle_t now, uint8_t cause);
void watchdog_run(rig_t *rig, cycle_t now);
void watchdog_feed(rig_t *rig);
