"""test bench export, German spreadsheet: CP1252, semicolon, decimal comma"""
import sys
from gen import *
def rec(name,iq,idd,rpm,turns,seed,t0=0.,fs=2000,torque=True,volt=False):
    t,thr,thm,ws,r,tr=sweep(S,S_ := SS,iq,idd,rpm,turns,fs,seed,tau=.0012,tzero=.15+.002*t0/60,tgain=1.012,tdrift=.0004,tn=.03,inoise=.03)
    with open(name,'w',encoding='cp1252') as f:
        f.write('Prüfstand 3;Motor IPM-12;Datum 12.03.2026;;;;\nZeit [ms];Winkel [°];Drehzahl [1/min];I_U [A];I_V [A];I_W [A];Moment [Nm]\n')
        for k in range(len(t)):
            f.write(';'.join([de(t[k]*1e3,1),de(np.degrees(thr[k])%360,3),de(ws[k]*30/np.pi,2),de(r[0,k],3),de(r[1,k],3),de(r[2,k],3),de(tr[k],3)])+'\n')
def volt(name,rpm,seed):
    t,thr,thm,ws,r,tr=sweep(S,SS,0,0,rpm,6,10000,seed,inoise=.0)
    rng=np.random.default_rng(seed); h=1e-6
    e=[(b-a)/(2*h)*ws+rng.normal(0,.1,len(t)) for a,b in zip(S.lam(thm-h),S.lam(thm+h))]
    with open(name,'w',encoding='cp1252') as f:
        f.write('Zeit [ms];Winkel [°];U_UV [V];U_VW [V]\n')
        for k in range(len(t)): f.write(';'.join([de(t[k]*1e3,2),de(np.degrees(thr[k])%360,3),de(e[0][k]-e[1][k],3),de(e[1][k]-e[2][k],3)])+'\n')
if __name__=='__main__':
    rec('s/leer_vor.csv',0,0,30,6,1)
    rec('s/leer_rueck.csv',0,0,-30,6,2,60)
    rec('s/last07.csv',7,0,30,6,3,120)
    rec('s/last14.csv',14,0,30,6,4,180)
    rec('s/last20.csv',20,0,30,6,5,240)
    rec('s/brems14.csv',-14,0,30,6,6,300)
    rec('s/feld14.csv',14,-9,30,6,7,360)
    rec('s/schnell14.csv',14,0,120,12,8,420)
    rec('s/rueck20.csv',-20,0,-30,6,9,480)
    volt('s/gen600.csv',600,10)
