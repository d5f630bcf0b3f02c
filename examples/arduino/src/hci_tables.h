/* All that a table on a microcontroller needs. */
#ifndef HCI_TABLES_H
#define HCI_TABLES_H

#include "hci/blob.h"
#include "hci/counter.h"
#include "hci/foc.h"
#include "hci/guard.h"
#include "hci/learn.h"
#include "hci/loop.h"
#include "hci/table.h"
#include "hci/table_i16.h"

#endif
