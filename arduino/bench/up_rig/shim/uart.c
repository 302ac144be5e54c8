/* USART 0, asynchronous, 8N1 (data sheet 20).
 *
 * simavr counts 11 bits a byte and receives into 64 places; here a frame has 10 bits, the receiver
 * two places and its shift register, and a byte for a full one is lost (20.7.4, DOR).
 */
#include <stdlib.h>

#include "rig.h"

enum { RXC = 0x80, TXC = 0x40, UDRE = 0x20, FE = 0x10, DOR = 0x08, U2X = 0x02 };
enum { RXEN = 0x10, TXEN = 0x08, FRAME_BITS = 10 };

static double bit_cycles(const rig_t *rig) {
    const uint8_t *data = rig->avr->data;
    unsigned divisor = (unsigned)(data[R_UBRR0L] | (data[R_UBRR0H] & 15) << 8) + 1;
    return divisor * (data[R_UCSR0A] & U2X ? 8.0 : 16.0);
}

static void show_received(rig_t *rig) {
    uint8_t *status = &rig->avr->data[R_UCSR0A];
    uart_t *uart = &rig->uart;
    *status &= (uint8_t)~(RXC | FE | DOR);
    if (uart->count) *status |= RXC | uart->errors[0];
    interrupts_refresh(rig);
}

/* The line's first byte is in when the middle of its stop bit has been sampled. */
static void plan_line(rig_t *rig) {
    uart_t *uart = &rig->uart;
    uart->due = NEVER;
    if (uart->line_count)
        uart->due = (cycle_t)(uart->line[uart->line_first].start + 9.5 * uart->line_bit);
    rig->is_planned = false;
}

void rig_uart_baud(rig_t *rig, double baud) {
    rig->uart.line_bit = CYCLES_PER_US * 1e6 / baud;
}

/* Puts bytes on the line, one frame after the other; flag 1 breaks the stop bit. */
void rig_uart_write(rig_t *rig, const uint8_t *bytes, uint32_t size, uint8_t flags) {
    uart_t *uart = &rig->uart;
    if (uart->line_first && uart->line_first >= uart->line_count) {
        for (size_t i = 0; i < uart->line_count; i++)
            uart->line[i] = uart->line[uart->line_first + i];
        uart->line_first = 0;
    }
    for (uint32_t i = 0; i < size; i++) {
        if (uart->line_first + uart->line_count == uart->line_room) {
            uart->line_room = uart->line_room ? uart->line_room * 2 : 256;
            uart->line = realloc(uart->line, uart->line_room * sizeof *uart->line);
        }
        double start = uart->line_free > (double)rig->avr->cycle ? uart->line_free
                                                                 : (double)rig->avr->cycle;
        size_t at = uart->line_first + uart->line_count++;
        uart->line[at].value = bytes[i];
        uart->line[at].flags = flags;
        uart->line[at].start = start;
        uart->line_free = start + FRAME_BITS * uart->line_bit;
    }
    plan_line(rig);
}

/* Bytes on the line that the chip has not received yet. */
uint32_t rig_uart_waiting(const rig_t *rig) { return (uint32_t)rig->uart.line_count; }

static void receive(rig_t *rig) {
    uart_t *uart = &rig->uart;
    uint8_t value = uart->line[uart->line_first].value, flags = uart->line[uart->line_first].flags;
    uart->line_first++;
    uart->line_count--;
    plan_line(rig);
    if (!(rig->avr->data[R_UCSR0B] & RXEN) || rig->reset_until) return;
    uint8_t errors = flags & 1 ? FE : 0;
    /* Beyond this mismatch the tenth bit is not sampled where it is (table 20-3). */
    double mismatch = bit_cycles(rig) / uart->line_bit;
    if (mismatch < 0.955 || mismatch > 1.045) {
        value ^= (uint8_t)next_random(rig);
        errors |= FE;
    }
    if (uart->count == 3) {
        uart->overruns++;
        uart->errors[2] |= DOR;
        return;
    }
    uart->buffer[uart->count] = value;
    uart->errors[uart->count++] = errors;
    show_received(rig);
}

static void begin(rig_t *rig, uint8_t value, cycle_t now) {
    uart_t *uart = &rig->uart;
    uart->is_sending = true;
    uart->sending = value;
    uart->send_end = now + (cycle_t)(FRAME_BITS * bit_cycles(rig));
    rig->is_planned = false;
}

static void sent(rig_t *rig) {
    uart_t *uart = &rig->uart;
    sent_t byte = {uart->send_end, uart->sending};
    record_add(&rig->sent, &byte, sizeof byte);
    uart->is_sending = false;
    if (uart->is_waiting) {
        uart->is_waiting = false;
        begin(rig, uart->waiting, uart->send_end);
        set_flag(rig, R_UCSR0A, UDRE);
    } else {
        set_flag(rig, R_UCSR0A, TXC);
    }
}

cycle_t uart_due(const rig_t *rig) {
    cycle_t due = rig->uart.due;
    return rig->uart.is_sending && rig->uart.send_end < due ? rig->uart.send_end : due;
}

void uart_run(rig_t *rig, cycle_t now) {
    if (rig->uart.due <= now) receive(rig);
    if (rig->uart.is_sending && rig->uart.send_end <= now) sent(rig);
}

static uint8_t on_data_read(avr_t *avr, avr_io_addr_t address, void *param) {
    rig_t *rig = param;
    (void)avr, (void)address;
    uart_t *uart = &rig->uart;
    run_events(rig, read_time(rig));
    uint8_t value = uart->buffer[0];
    if (uart->count) {
        uart->count--;
        for (int i = 0; i < uart->count; i++) {
            uart->buffer[i] = uart->buffer[i + 1];
            uart->errors[i] = uart->errors[i + 1];
        }
    }
    show_received(rig);
    return value;
}

static void on_data_write(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param) {
    rig_t *rig = param;
    (void)address;
    uart_t *uart = &rig->uart;
    run_events(rig, write_time(rig));
    if (!(avr->data[R_UCSR0B] & TXEN) || uart->is_waiting) return;
    if (uart->is_sending) {
        uart->waiting = value;
        uart->is_waiting = true;
        avr->data[R_UCSR0A] &= (uint8_t)~UDRE;
    } else {
        begin(rig, value, write_time(rig));
    }
    avr->data[R_UCSR0A] &= (uint8_t)~TXC;
    interrupts_refresh(rig);
}

static void on_status_write(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param) {
    rig_t *rig = param;
    run_events(rig, write_time(rig));
    uint8_t kept = avr->data[address] & (uint8_t)~(U2X | 1);
    avr->data[address] = (uint8_t)((kept & ~(value & TXC)) | (value & (U2X | 1)));
    interrupts_refresh(rig);
}

static void on_control_write(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param) {
    rig_t *rig = param;
    run_events(rig, write_time(rig));
    avr->data[address] = value;
    if (!(value & RXEN)) {
        rig->uart.count = 0;
        show_received(rig);
    }
    interrupts_refresh(rig);
}

void uart_reset(rig_t *rig) {
    uart_t *uart = &rig->uart;
    uart->count = 0;
    uart->is_waiting = uart->is_sending = false;
    rig->avr->data[R_UCSR0A] = UDRE;
    rig->avr->data[R_UCSR0C] = 6;
}

void uart_hook(rig_t *rig) {
    rig->uart.due = NEVER;
    rig_uart_baud(rig, 115200);
    hook_read(rig, R_UDR0, on_data_read);
    hook_write(rig, R_UDR0, on_data_write);
    hook_read(rig, R_UCSR0A, read_register);
    hook_write(rig, R_UCSR0A, on_status_write);
    hook_write(rig, R_UCSR0B, on_control_write);
}
