from ver import *
import sys
f=sys.argv[1];ex=' '.join(sys.argv[2:]);per=build(f+'/table','./simti')
a=run('./simti',f'motor=0 skip=0.2 rpm=60 T=2.2 table=1 ideal=1 period={per} '+ex);m,r=pp(a);print(' ',f,'IDEAL currents: mean %.3f pp %.3f'%(m,r),orders(a,4))
a=run('./simti',f'motor=0 skip=1.2 rpm=10 T=7.2 table=1 bw=800 period={per} '+ex);m,r=pp(a);print(' ',f,'loop 800 Hz 10 rpm: mean %.3f pp %.3f'%(m,r),orders(a,4))
