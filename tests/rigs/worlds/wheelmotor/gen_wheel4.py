from gen_wheel import *
import gen_wheel as gw, os
def rec3(name,iq,idd,rpm,turns,seed,t0=0.,fs=80,lever=.2,tau=.02):
    t,thr,thm,ws,r,tr=sweep(Wm,SW,iq,idd,rpm,turns,fs,seed,tau=tau,tzero=0.35+.0006*t0,tgain=.985,tdrift=.0002,tn=.03,inoise=.12,wob=.004)
    v=np.gradient(thr,t)/2/np.pi
    with open(name,'w') as f:
        f.write('timestamp_us\tpos [turn]\tIa [A]\tIb [A]\tIc [A]\tcell_N\n')
        for k in range(len(t)): f.write('%d\t%.6f\t%.3f\t%.3f\t%.3f\t%.2f\n'%(t[k]*1e6+12345,thr[k]/2/np.pi,r[0,k],r[1,k],r[2,k],tr[k]/lever))
if __name__=="__main__": os.makedirs('w/abc',exist_ok=True)
if __name__=="__main__":
  for n,iq,r,s,t0 in (('free_f',0,.5,1,0),('free_b',0,-.5,2,300),('load20',20,.5,3,600),('load40',40,.5,4,900),('brake40',-40,.5,5,1200),('load30b',-30,-.5,6,1500),('load10',10,.5,7,1800)): rec3('w/abc/%s.tsv'%n,iq,0,r,2.2,s,t0)
