#include "cli/init/init_words.h"

#include "cli/terminal/say.h"
#include "cli/terminal/text.h"

static void show_constants(const hci_sheet *s)
{
    const double emf = hci_sheet_emf(s->reading, s->strength, s->pole_pairs);
    cli_say("  pole pairs   %d (%d magnets)\n", s->pole_pairs, 2 * s->pole_pairs);
    cli_say("  back-EMF     %.5g V·s/rad, peak of a phase, from %g %s read as %s\n", emf, s->strength,
            hci_sheet_unit(s->reading), hci_sheet_meaning(s->reading));
    cli_say("  which is, to compare with the sheet (if one of them differs by 1.41 or 1.73, the "
            "reading is another):\n");
    for (int reading = 0; reading <= (int)HCI_SHEET_FLUX; ++reading)
        cli_say("    %10.5g %-7s %s\n", hci_sheet_value((hci_sheet_reading)reading, emf, s->pole_pairs),
                hci_sheet_unit((hci_sheet_reading)reading), hci_sheet_meaning((hci_sheet_reading)reading));
}

static void show_next(const hci_sheet *s, const char *folder)
{
    const int p = s->pole_pairs;
    cli_say("next\n"
            "  open the tables: what is missing stands there, with how to measure it\n"
            "  harmonics, which make the ripple, are in no data sheet; measure and take them over:\n");
    cli_say("    hci-solve harmonics RUN --quantity back_emf --pole-pairs %d -o %s\n", p, folder);
    cli_say("    hci-solve harmonics RUN --quantity cogging --pole-pairs %d -o %s\n", p, folder);
    cli_say("  currents for the torque you want:\n"
            "    hci-solve solve %s --target FILE --auto -o OUT\n",
            folder);
    cli_say("  when the bench disagrees:\n"
            "    hci-solve diagnose %s --runs LIST -o OUT\n",
            folder);
}

void cli_show_sheet(const hci_sheet *s, const char *folder)
{
    hci_note remark;
    cli_say(CLI_GOOD "machine" CLI_PLAIN ": %s: machine.csv, back_emf.csv%s%s\n", folder,
            s->slots > 0 ? ", cogging.csv" : "", hci_sheet_is_salient(s) ? ", inductance.csv" : "");
    hci_sheet_remark(s, &remark);
    cli_remark(&remark);
    show_constants(s);
    if (s->slots > 0)
        cli_say("  cogging      first at order %d (%d in a mechanical turn); amplitudes 0 until measured\n",
                hci_cogging_order(s->slots, s->pole_pairs),
                s->pole_pairs * hci_cogging_order(s->slots, s->pole_pairs));
    if (hci_sheet_is_salient(s))
        cli_say(
            "  inductance   L_d and L_q differ: interior magnets, with reluctance torque; its harmonics are "
            "not known\n");
    show_next(s, folder);
}
