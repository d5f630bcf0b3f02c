/* Instructions of one call, counted in an emulator on tables that the compiler sees as constants
 * (tests/host/emit/emit_mcu.sh counts some of them again). GCC 12.2, -O2; Cortex-M0+ has no floating-point
 * unit. */
#include "host/emit/cost.h"

typedef struct {
    unsigned m4f, m0_plus;
} cost;

/* [frame][parts − 1]. */
static const cost F32[2][2] = {{{29, 904}, {61, 1983}}, {{21, 801}, {47, 1880}}};

/* [frame][parts − 1][degree − 1]; of phase currents with phases and signs to change. */
static const cost I16[2][2][3] = {{{{49, 629}, {63, 657}, {82, 699}}, {{89, 1781}, {117, 1857}, {155, 1915}}},
                                  {{{27, 418}, {41, 449}, {59, 487}}, {{51, 1181}, {80, 1243}, {127, 1309}}}};
static const cost Q15[2][2][3] = {{{{47, 67}, {61, 89}, {79, 142}}, {{88, 157}, {115, 237}, {156, 301}}},
                                  {{{26, 41}, {42, 68}, {59, 109}}, {{54, 86}, {82, 156}, {119, 247}}}};

static const cost I8[2][2][3] = {{{{48, 70}, {62, 95}, {85, 153}}, {{91, 153}, {119, 245}, {174, 332}}},
                                 {{{29, 44}, {44, 74}, {66, 120}}, {{58, 86}, {85, 171}, {133, 262}}}};

void hci_emit_cost(const hci_tabulation *t, hci_emit_choice *choice)
{
    const size_t part = t->parts - 1, frame = t->frame == HCI_TABLE_ABC ? 0 : 1;
    const size_t degree = (size_t)(choice->shape - HCI_EMIT_LINEAR);
    const cost c = hci_emit_has_rows(choice->format) ? F32[frame][part]
                   : choice->format == HCI_EMIT_I16  ? I16[frame][part][degree]
                   : choice->format == HCI_EMIT_I8   ? I8[frame][part][degree]
                                                     : Q15[frame][part][degree];
    choice->cortex_m4f = c.m4f;
    choice->cortex_m0_plus = c.m0_plus;
}
