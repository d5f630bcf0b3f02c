/* Version of the library and of the formats it writes. CMake reads it from here. */
#ifndef HCI_VERSION_H
#define HCI_VERSION_H

/* While this is 0, the interface may change with each minor version. */
#define HCI_VERSION_MAJOR 0

/* Grows with the interface. */
#define HCI_VERSION_MINOR 1

/* Grows with corrections. */
#define HCI_VERSION_PATCH 0

/* The three of them, with points. */
#define HCI_VERSION_STRING "0.1.0"

#endif
