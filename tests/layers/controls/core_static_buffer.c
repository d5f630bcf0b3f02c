/* Must be refused: "core-writable: core_static_buffer.o has 800 bytes of .bss". */
double *hci_control_static_buffer(void);

double *hci_control_static_buffer(void)
{
    static double buffer[100];
    return buffer;
}
