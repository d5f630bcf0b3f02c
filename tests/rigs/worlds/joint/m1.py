# Motor 1: frameless joint motor 21 pole pairs 36 slots, ODrive; own shaft integration. SECRET imperfections here.
import math, random
import numpy as np
P=21; KV=95.0
KT_TRUE=8.27/KV*0.972       # magnets 2.8 % weak against the sheet
R=0.4
J=4.5e-4
TC=0.028; TCB=0.021; B=4e-4     # coulomb forward/backward differs (seal)
# cogging in mech orders: (order, amp Nm, phase) T=A sin(n th + ph)
COG=[(252,0.014,0.7),(36,0.009,-1.1),(42,0.0025,2.0),(72,0.004,0.3),(504,0.0018,1.0),(40,0.003,0.9)]
# emf shape k(theta_e): 1 + harmonics of sine 5,7 => q-axis torque function per ampere rel orders 6,12 and d-axis too
K5,K7,K11,K13=-0.022,0.011,0.006,0.004
ECC=math.radians(0.22); ECCP=0.6     # encoder reading error, mech, once a turn
ECC2=math.radians(0.05); ECC2P=1.9
GA,GB,OA,OB=1.012,0.995,0.030,-0.018   # sensor gains/offset of phases a,b (c from sum)
def emf(te):
    out=[]
    for s in (0,1,2):
        x=te-2*math.pi/3*s
        out.append(math.sin(x)+K5*math.sin(5*x+0.2)+K7*math.sin(7*x-0.5)+K11*math.sin(11*x)+K13*math.sin(13*x+1))
    return out
KE=KT_TRUE*2/3  # phase peak per mech rad/s: T = KE*sum(e*i), i_a = iq sin -> 3/2 KE iq
def cog(th): return sum(a*math.sin(n*th+p) for n,a,p in COG)
def enc(th): return th+ECC*math.sin(th+ECCP)+ECC2*math.sin(2*th+ECC2P)
E0=1.2345  # encoder zero against electrical zero, elec rad: drive calibrated with error
CAL=math.radians(4.0) # calibration error of the drive's commutation, elec
def phases(idq_ref, thenc):
    """drive holds measured dq = ref in its own frame; returns true phase currents"""
    d,q=idq_ref; te=P*thenc+CAL
    m=[q*math.sin(te-2*math.pi/3*s)-d*math.cos(te-2*math.pi/3*s) for s in range(3)]
    a=(m[0]-OA)/GA; b=(m[1]-OB)/GB
    return a,b,-a-b
def torque_el(idq,th):
    a=phases(idq,enc(th)); e=emf(P*th)
    return KE*(a[0]*e[0]+a[1]*e[1]+a[2]*e[2])
def run(profile,dur,fs_log,load=lambda t,th:0.0,kp=0.25,ki=2.5,seed=1,dt=1.25e-4,th0=0.3):
    """profile(t)-> position setpoint turns,vel. ODrive: position P + velocity PI"""
    rnd=random.Random(seed); th=th0;w=0.0;integ=0.0;rows=[];tn=0.0;iq=0.0
    n=int(dur/dt); last=enc(th)/(2*math.pi); west=0.0
    for k in range(n):
        t=k*dt
        pe=enc(th)/(2*math.pi); pq=math.floor(pe*16384*4+rnd.random()*0.6)/(16384*4)
        ve=(pe-last)/dt; last=pe; west+=(ve-west)*dt*600
        ps,vs=profile(t)
        vc=vs+20*(ps-pe)
        err=(vc-west)*2*math.pi
        integ+=ki*err*dt
        isp=(kp*err+integ)/KT_TRUE
        isp=max(-12,min(12,isp))
        iq+=(isp-iq)*dt*2*math.pi*800
        T=torque_el((0,iq),th)+cog(th)
        ld=load(t,th)
        tot=T-ld-B*w
        fr=TC if w>0 else TCB
        if abs(w)<1e-4 and abs(tot)<fr: w=0.0
        else:
            s=1 if (w>1e-4 or (abs(w)<=1e-4 and tot>0)) else -1
            wn=w+dt*(tot-(TC if s>0 else -TCB))/J
            w=0.0 if wn*s<0 and abs(w)>1e-4 else wn
        th+=w*dt
        if t>=tn:
            rows.append((t+abs(rnd.gauss(0,2e-4)),pq,west,iq+rnd.gauss(0,0.012),isp,24.1-0.01*iq+rnd.gauss(0,.01)))
            tn+=1/fs_log*(1+rnd.uniform(-.25,.35))+(0.012 if rnd.random()<0.003 else 0)
    return rows
def write(path,rows):
    with open(path,'w') as f:
        f.write('time,pos_estimate,vel_estimate,Iq_measured,Iq_setpoint,vbus_voltage\n')
        for r in rows: f.write('%.4f,%.6f,%.5f,%.4f,%.4f,%.2f\n'%r)
def trap(v,turns,wait=0.5):
    T=turns/v
    def p(t):
        if t<wait: return 0.3/(2*math.pi),0
        t-=wait
        b=0.3/(2*math.pi)
        if t<T: return b+v*t,v
        if t<T+wait: return b+turns,0
        t-=T+wait
        if t<T: return b+turns-v*t,-v
        return b,0
    return p,2*T+2.5*wait
def truth(idq_fun,n=252*16,extra=None):
    """torque over one mech turn when the drive plays idq_fun(enc angle rad)"""
    ths=np.arange(n)*2*math.pi/n; out=[]
    for th in ths: out.append(torque_el(idq_fun(enc(th)),th)+cog(th))
    return ths,np.array(out)
if __name__=='__main__':
    import os
    os.makedirs('../m1',exist_ok=True)
    pr,d=trap(8/60,1.25); write('../m1/slow.csv',run(pr,d,480,seed=1))
    pr,d=trap(5/60,1.2); write('../m1/slow5.csv',run(pr,d,400,seed=2))
    pr,d=trap(8/60,1.25); write('../m1/weight.csv',run(pr,d,480,load=lambda t,th:0.55,seed=3))
    pr,d=trap(8/60,1.25); write('../m1/brake.csv',run(pr,d,480,load=lambda t,th:0,seed=4)) if 0 else None
    # powder brake against the motion
    s=[0]
    pr,d=trap(8/60,1.25)
    write('../m1/brake.csv',run(pr,d,480,load=lambda t,th:(0.6 if t<0.5+1.25/(8/60)+.25 else -0.6),seed=4))
