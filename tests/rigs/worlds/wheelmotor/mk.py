import re
def rows(f,enc='cp1252'): return open(f,encoding=enc).read().split('\n')
def de(x,n=3): return (f'%.{n}f'%x).replace('.',',')
def conv(src,dst,fn,hdr=None):
    L=rows(src); H=L[:2]
    if hdr: H[1]=hdr
    out=H+[';'.join(fn(l.split(';'))) for l in L[2:] if l]
    open(dst,'w',encoding='cp1252').write('\n'.join(out)+'\n')
f=lambda s: float(s.replace(',','.'))
runs=['leer_vor','last07','last14','last20','leer_rueck']
import os
def each(d,fn,hdr=None):
    os.makedirs('m/'+d,exist_ok=True)
    for r in runs: conv(f's/{r}.csv',f'm/{d}/{r}.csv',fn,hdr)
each('swap',lambda c:c[:3]+[c[3],c[5],c[4],c[6]])                      # V and W swapped
each('elec',lambda c:[c[0],de((f(c[1])*3)%360,3)]+c[2:])                # electrical angle named Winkel
each('rad',lambda c:c,'Zeit [ms];Winkel [rad];Drehzahl [1/min];I_U [A];I_V [A];I_W [A];Moment [Nm]') # degrees labelled rad
each('mA',lambda c:c[:3]+[de(f(x)*1000,0) for x in c[3:6]]+[c[6]])       # mA labelled A
each('names',lambda c:c,'Kanal1;Kanal2;Kanal3;Kanal4;Kanal5;Kanal6;Kanal7')
each('rms',lambda c:c[:3]+[de(f(x)/2**.5,3) for x in c[3:6]]+[c[6]])      # currents /sqrt2
each('sign',lambda c:c[:6]+[de(-f(c[6]),3)])                             # torque sign
each('tmNm',lambda c:c,'Zeit [ms];Winkel [°];Drehzahl [1/min];I_U [A];I_V [A];I_W [A];Moment [mNm]')
each('anglerev',lambda c:[c[0],de((360-f(c[1]))%360,3)]+c[2:])           # encoder counts the other way
each('sec',lambda c:c,'Zeit [s];Winkel [°];Drehzahl [1/min];I_U [A];I_V [A];I_W [A];Moment [Nm]')
L=rows('s/last14.csv')
os.makedirs('m/x',exist_ok=True)
open('m/x/empty.csv','w').write('')
open('m/x/header.csv','w',encoding='cp1252').write('\n'.join(L[:2])+'\n')
conv('s/last14.csv','m/x/still.csv',lambda c:[c[0],'18,257','0,00','0,010','-14,10','14,09',c[6]])
open('m/x/noangle.csv','w',encoding='cp1252').write('\n'.join([L[1]]+L[2:]).replace('Winkel','Kraftweg'))
open('m/x/short.csv','w',encoding='cp1252').write('\n'.join(L[:700])+'\n')
