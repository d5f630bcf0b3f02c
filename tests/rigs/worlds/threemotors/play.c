#include <stdio.h>
#include "tuned.h"
int main(void){ int n=20000; printf("%d\n", n);
 for(int i=0;i<n;i++){ uint32_t a=(uint32_t)(4294967296.0*i/n); hci_currents_dq c=hci_table_f32_dq(&tuned,a); printf("%.7g %.7g\n",c.id_A,c.iq_A);} return 0;}
