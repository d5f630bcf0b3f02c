/* Version of the library and of the formats it writes. CMake reads it from here. */
#ifndef HCI_VERSION_H
#define HCI_VERSION_H

#define HCI_VERSION_MAJOR  0
#define HCI_VERSION_MINOR  1
#define HCI_VERSION_PATCH  0
#define HCI_VERSION_STRING "0.1.0"

#endif
