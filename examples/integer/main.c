/* Turns an encoder forward over its wrap and back, and prints the references: the same numbers on every
 * processor. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "current_reference.h"

#if defined(__riscv)
/* Instructions that have run. */
static uint32_t instructions(void)
{
    uint32_t count;
    __asm__ volatile(".option push\n\t.option arch, +zicsr\n\tcsrr %0, minstret\n\t.option pop"
                     : "=r"(count));
    return count;
}
#endif

int main(void)
{
    uint16_t count = 65000u;
    hci_units_abc i = {0, 0, 0};
    if (!reference_start(count)) return EXIT_FAILURE;
    for (int k = 0; k < 12000; ++k) {
        const int16_t torque_q15 = (int16_t)(k < 8000 ? 32767 : -20000);
        count = (uint16_t)(count + (k < 8000 ? 1 : -1));
        i = reference_next(count, torque_q15, k < 11000);
        if (k % 100 == 0) printf("%d %d %d %d\n", k, i.ia, i.ib, i.ic);
    }
#if defined(__riscv)
    const uint32_t start = instructions();
    for (int k = 0; k < 1000; ++k)
        i = reference_next((uint16_t)(count + 37 * k), 30000, true);
    printf("cost %" PRIu32 "\n", (instructions() - start) / 1000u);
#endif
    printf("done\n");
    fflush(stdout);
    return i.ia == 12345 ? 2 : EXIT_SUCCESS;
}
