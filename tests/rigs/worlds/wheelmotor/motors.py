"""Three invented machines. Torque = dW'/dtheta at constant phase currents (energy-consistent), + friction, iron drag."""
import numpy as np
C=2*np.pi/3
def park(th,ia,ib,ic):
    # ia = iq sin - id cos
    s=[np.sin(th-k*C) for k in range(3)]; c=[np.cos(th-k*C) for k in range(3)]
    iq=2/3*(ia*s[0]+ib*s[1]+ic*s[2]); idd=-2/3*(ia*c[0]+ib*c[1]+ic*c[2]); return idd,iq
def inv(th,idd,iq): return [iq*np.sin(th-k*C)-idd*np.cos(th-k*C) for k in range(3)]
class Motor:
    def lam(self,thm):
        """PM flux of the phases: psi_k; e_k=dpsi/dthm positive sine => psi=-cos"""
        out=[]
        for k in range(3):
            th=self.p*thm-k*C; w=0
            for n,a,ph in self.emf: w=w-a/(n*self.p)*np.cos(n*th+ph)
            mod=1
            for m,a,ph in self.uneq: mod=mod+a*np.cos(m*thm+ph-0.0)   # seen by the phase as a whole (parallel paths off)
            out.append(self.gain[k]*w*mod)
        return out
    def W(self,thm,i):
        th=self.p*thm; l=self.lam(thm); idd,iq=park(th,*i)
        w=0
        for k in range(3):
            w=w+l[k]*i[k]
        return w+self.Wsal(th,thm,idd,iq)
    def Wsal(self,th,thm,idd,iq): return 0
    def cog(self,thm):
        t=0
        for m,a,ph in self.cogm: t=t+a*np.sin(m*thm+ph)     # mechanical orders
        return t
    def em(self,thm,i):
        h=1e-5
        return (self.W(thm+h,i)-self.W(thm-h,i))/(2*h)+self.cog(thm)
    def drag(self,w): 
        return self.coul*np.tanh(w/0.02)+self.visc*w+self.iron*np.sign(w)*np.abs(w)**0.5
    def shaft(self,thm,w,i): return self.em(thm,i)-self.drag(w)

class Gimbal(Motor):           # 24N22P, hobby
    p=11; uneq=[(1,0.012,0.4)]
    K=0.245                     # N.m/A true; the sheet says kv 36 (line-peak)
    emf=[(1,K,0),(5,-.011*K,.2),(7,.006*K,.5),(11,.002*K,0),(3,.05*K,0)]
    gain=[1,1.006,.996]
    cogm=[(264,.0032,.9),(22,.0021,1.7),(24,.0058,-.6),(66,.0009,.2),(48,.0014,2.),(2,.0012,.5)]
    coul=.011; visc=.0006; iron=.0; J=2.1e-4
    def Wsal(self,th,thm,idd,iq): return 1.5*(.5*.0024*idd**2+.5*.0025*iq**2)
class Servo(Motor):            # IPM 3 pole pairs, 36 slots
    p=3; uneq=[]
    psi=.245; emf=[(1,psi*3,0),(5,.014*psi*3,2.9),(7,.009*psi*3,.4),(11,.021*psi*3,-.3),(13,.012*psi*3,1.2),(3,.06*psi*3,0)]
    gain=[1.004,.997,.999]
    cogm=[(36,.115,.7),(72,.022,-1.1),(18,.035,.3),(6,.014,1.0),(3,.010,.2)]
    coul=.11; visc=.0011; iron=.012; J=4e-3
    def Wsal(self,th,thm,idd,iq):
        Ld=.0052; Lq=.0118; Is=26*(1+.05*np.cos(6*th+.4)+.06*np.cos(12*th-.7))
        lc=lambda x: np.abs(x)+np.log1p(np.exp(-2*np.abs(x)))-np.log(2)
        wq=Lq*Is**2*lc(iq/Is)
        Ldt=Ld*(1+.03*np.cos(6*th+1.0)+.02*np.cos(12*th))
        x=(iq/30.)**2/(1+(iq/30.)**2)
        # cross saturation: magnets' and d flux sink with iq
        wc=-(.085*self.psi*(idd+8.)+ .0007*idd**2)*x - (.03*self.psi*idd*np.cos(6*th+.9))*x
        return 1.5*(wq+.5*Ldt*idd**2+wc)
class Wheel(Motor):            # axial flux 10 pp, 24 slots
    p=10; K=.92; uneq=[(1,.022,.7),(2,.008,-.4)]
    emf=[(1,K,0),(5,.022*K,-.3),(7,-.013*K,.15),(11,.004*K,.8),(13,.003*K,0),(3,.09*K,.1)]
    gain=[1,.992,1.003]
    cogm=[(120,.16,.5),(240,.02,1.),(24,.12,-.9),(20,.07,.6),(60,.03,.1),(1,.05,.3)]
    coul=.28; visc=.02; iron=.05; J=.06
    def Wsal(self,th,thm,idd,iq):
        L=.00042; Is=75*(1+.07*np.cos(6*th+.5))
        lc=lambda x: np.abs(x)+np.log1p(np.exp(-2*np.abs(x)))-np.log(2)
        x=(iq/60.)**2/(1+(iq/60.)**2)
        return 1.5*(L*Is**2*lc(iq/Is)+.5*L*.96*idd**2-.06*self.K/self.p*(idd+20.)*x)

class Sensors:
    def __init__(s,p,g=(0,0,0),o=(0,0,0),ecc=(),harm=(),off=0,counts=None):
        s.p,s.g,s.o,s.ecc,s.harm,s.off,s.counts=p,np.array(g),np.array(o),ecc,harm,off,counts
    def angle(s,thm):
        r=thm+0.
        for m,a,ph in s.ecc: r=r+a*np.sin(m*thm+ph)
        if s.counts: q=2*np.pi/s.counts; r=np.floor(r/q)*q
        return r+s.off/s.p            # off: electrical zero
    def true_currents(s,thr,idr,iqr,noise,rng,cor_g=(0,0,0),cor_o=(0,0,0)):
        """drive imposes, in the frame of angle thr (electrical), corrected readings; perfect loop on alpha-beta"""
        ref=inv(thr,idr,iqr)
        G=(1+s.g)/(1+np.array(cor_g)); O=(s.o-np.array(cor_o))/(1+np.array(cor_g))
        T=np.array([[2/3,-1/3,-1/3],[0,1/3**.5,-1/3**.5]])
        S=np.array([[1,0],[-.5,3**.5/2],[-.5,-3**.5/2]])
        A=T@np.diag(G)@S; b=T@O
        ab=T@np.array(ref)-b[:,None]
        x=np.linalg.solve(A,ab)
        i=S@x
        if noise: i=i+rng.normal(0,noise,i.shape)-0; 
        i=i-i.mean(0)
        return i
    def read(s,i): return (1+s.g)[:,None]*i+s.o[:,None]
