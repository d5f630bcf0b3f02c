/* Must be refused: "core-writable: core_common.o has the common symbol hci_control_common". */
__attribute__((common)) double hci_control_common[10];
