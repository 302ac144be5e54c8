/**
 * The registers used by the sources of src/chip, as far as they are compiled here: plain memory,
 * read by the hardware of this folder. Numbers of bits are those of the data sheet.
 */
#pragma once

#include <stdint.h>

#define _BV(bit) (1 << (bit))

enum StatusBit { SREG_I = 7 };
enum ResetBit { PORF = 0, EXTRF = 1, BORF = 2, WDRF = 3 };
enum LineBit { U2X0 = 1, UCSZ00 = 1, UCSZ01 = 2, TXEN0 = 3, RXEN0 = 4, UDRIE0 = 5, RXCIE0 = 7 };
enum AnalogBit { ADPS0 = 0, ADPS1, ADPS2, ADATE = 5, ADSC, ADEN, REFS0 = 6, REFS1 };
enum PinBit { PCIF0 = 0, PCIF2 = 2 };

extern uint8_t SREG, MCUSR, ADMUX, ADCSRA, DDRB, PORTB, PINB, GPIOR0, GPIOR1, TCNT2, PCIFR;
extern uint8_t UCSR0A, UCSR0B, UCSR0C, UDR0;
extern uint16_t UBRR0, ADC;
