#include <stdio.h>
#define Q(x) #x
#define H(x) Q(x)
#include H(HDR)
int main(void){ printf("%d %u %u %u %u %g\n",(int)NAME.frame,NAME.period_turns,NAME.points,NAME.columns,NAME.parts,NAME.peak_A);
 for(unsigned i=0;i<NAME.points*NAME.columns*NAME.parts;i++) printf("%.9g\n",NAME.rows[i]); return 0;}
