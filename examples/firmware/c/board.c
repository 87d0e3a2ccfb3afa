/* What a program needs on a Cortex-M under QEMU: vectors, the floating-point unit, a console, an end. */
#include <stddef.h>
#include <stdint.h>
#include "board.h"

int main(void);
void reset(void);
void fault(void);
void SysTick_Handler(void);
void *memcpy(void *to, const void *from, size_t n);
void __aeabi_memcpy(void *to, const void *from, size_t n);
void __aeabi_memcpy4(void *to, const void *from, size_t n);
void __aeabi_memclr4(void *to, size_t n);
void *memset(void *to, int byte, size_t n);

static void call_host(uint32_t operation, uintptr_t argument)
{
    register uint32_t r0 __asm__("r0") = operation;
    register uintptr_t r1 __asm__("r1") = argument;
    __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
}

void put(const char *text)
{
    call_host(0x04u, (uintptr_t)text);
}

void *memcpy(void *to, const void *from, size_t n)
{
    volatile unsigned char *out = to;
    const unsigned char *in = from;
    for (size_t k = 0; k < n; ++k) {
        out[k] = in[k];
    }
    return to;
}

void *memset(void *to, int byte, size_t n)
{
    volatile unsigned char *out = to;
    for (size_t k = 0; k < n; ++k) {
        out[k] = (unsigned char)byte;
    }
    return to;
}

void __aeabi_memcpy(void *to, const void *from, size_t n)
{
    memcpy(to, from, n);
}

void __aeabi_memcpy4(void *to, const void *from, size_t n)
{
    memcpy(to, from, n);
}

void __aeabi_memclr4(void *to, size_t n)
{
    memset(to, 0, n);
}

extern uint32_t bss_start;
extern uint32_t bss_end;
extern const char stack_top;

void reset(void)
{
    for (volatile uint32_t *word = &bss_start; word < &bss_end; ++word) {
        *word = 0u;
    }
    *(volatile uint32_t *)0xe000ed88u |= 0xfu << 20; /* the floating-point unit */
    __asm__ volatile("dsb\n\tisb" : : : "memory");
    main();
    call_host(0x18u, 0x20026u); /* the program is through */
    for (;;) {
    }
}

void fault(void)
{
    call_host(0x18u, 0x20024u); /* an error */
    for (;;) {
    }
}

/* Where a program has no interrupt of its own. */
__attribute__((weak)) void SysTick_Handler(void)
{
    fault();
}

/* By the numbers of exceptions: the stack is in place of 0, SysTick is 15. */
static const struct {
    const char *stack;
    void (*handlers[15])(void);
} vectors __attribute__((section(".vectors"), used)) = {
    &stack_top,
    {reset, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault,
     SysTick_Handler},
};
