/* Reset: variables initialised, main called. */
#include <stdint.h>
#include <stdlib.h>

extern uint32_t stack_top, data_start, data_end, data_load, bss_start, bss_end; /* from the linker script */

void initialise_monitor_handles(void); /* semihosting: printf goes to the debugger, or to QEMU */
int main(void);
void reset_handler(void);
void fault_handler(void);

void reset_handler(void)
{
    const uint32_t *from = &data_load;
    for (uint32_t *to = &data_start; to < &data_end; ++to)
        *to = *from++;
    for (uint32_t *to = &bss_start; to < &bss_end; ++to)
        *to = 0u;
    initialise_monitor_handles();
    _Exit(main());
}

void fault_handler(void)
{
    _Exit(EXIT_FAILURE);
}

typedef union {
    uint32_t *stack;
    void (*handler)(void);
} vector;

/* NMI and the hard fault; this example enables no interrupt. */
__attribute__((section(".vectors"), used)) static const vector vectors[] = {
    {.stack = &stack_top},
    {.handler = reset_handler},
    {.handler = fault_handler},
    {.handler = fault_handler},
};
