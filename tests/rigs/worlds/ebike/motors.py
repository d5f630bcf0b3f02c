"""Three motors of my own. Truths stand here, written before anything was run. theta = electrical, conv. of README."""
import numpy as np
from numpy import sin, cos, pi
def phases(th, n, E, g):  # e of each phase, order n
    return [E*sin(n*(th-k*2*pi/3)+g) for k in range(3)]
def abc(th, d, q):
    return [q*sin(th-k*2*pi/3)-d*cos(th-k*2*pi/3) for k in range(3)]
def dq(th, a, b, c):
    al=(2*a-b-c)/3; be=(b-c)/np.sqrt(3)
    return -al*cos(th)-be*sin(th), al*sin(th)-be*cos(th)
class H:  # e-bike mid-drive, 10 pole pairs, 18 slots, powder brake, CAN
    p=10; ke=0.53; emf=[(1,.53,0),(5,.0135,.4),(7,.0066,2.6),(11,.0030,1.0)]
    cog=[(18,.35,.7),(36,.05,-1.2),(1.8,.10,.3),(2.0,.12,-2.0),(0.1,.06,1.1)]
    Tc=.6; B=.03   # before the sensor; N·m, N·m s/rad
    def torque(s, thm, d, q):   # thm unwrapped mechanical, true
        th=s.p*thm; i=abc(th,d,q); T=0
        for n,E,g in s.emf:
            e=phases(th,n,E,g); T=T+sum(x*y for x,y in zip(e,i))
        m2=(d*d+q*q)/900.
        T=T*(1-.09*m2/(1+.3*m2)) + .25*(np.hypot(d,q)/30)**3*np.sign(q)*sin(6*th+1.9)
        return T+sum(A*sin(n*th+g) for n,A,g in s.cog)
    def angle_read(s, thm):     # what the drive believes (mechanical rad)
        return thm+np.radians(.18)*sin(thm+.5)+np.radians(.06)*sin(2*thm-1)+np.radians(.25) # .25 deg mech = 2.5 deg el zero
    gain=(1.02,.995,1.01); off=(.35,-.20,.10)      # current sensors of the drive, A
class S:  # servo, interior magnets, 4 pole pairs, 24 slots
    p=4; ke=.36; emf=[(1,.36,0),(5,.0108,2.9),(7,.0054,.5),(11,.0036,1.7),(13,.0020,-.4)]
    cog=[(6,.08,1.3),(12,.03,-.6),(.25,.015,.2),(24,.006,2.)]
    Ld=5.0e-3; Lq=11e-3; I0=18.; cx=1.1e-5; k6=.035; g6=.9; d6=.02
    Tc=.06; B=.0012
    def W(s, th, d, q):
        f=s.Lq*s.I0**2*(np.sqrt(1+(q/s.I0)**2)-1)
        return 1.5*(.5*s.Ld*d*d*(1+s.d6*cos(6*th-.5)) + f*(1+s.k6*cos(6*th+s.g6)+.012*cos(12*th+2.1)) - s.cx*q*q*d/(1+(q/25)**2)*8)
    def torque(s, thm, d, q):
        th=s.p*thm; i=abc(th,d,q); T=0
        for n,E,g in s.emf:
            e=phases(th,n,E,g); T=T+sum(x*y for x,y in zip(e,i))
        h=1e-4
        ld=(s.W(th,d+h,q)-s.W(th,d-h,q))/(2*h)/1.5; lq=(s.W(th,d,q+h)-s.W(th,d,q-h))/(2*h)/1.5
        T=T+s.p*1.5*(ld*q-lq*d)+s.p*(s.W(th+h,d,q)-s.W(th-h,d,q))/(2*h)
        return T+sum(A*sin(n*th+g) for n,A,g in s.cog)
    zero=np.radians(37.3)   # mechanical: encoder reads thm+zero
    probe=(1.012,.985); poff=(.06,-.04)
class G:  # robot joint, 14 pole pairs, 24 slots, position loop only
    p=14; ke=.0568; emf=[(1,.0568,0),(5,.0009,.8),(7,.0006,-1.)]
    cog=[(12,.012,.4),(24,.0015,2.2),(24/14,.004,-.7),(2.,.003,1.5),(1/14,.0015,.9)]
    J=2e-4; Tc=.02; B=3e-4; Ts=.003; ws=.4
    def torque(s, thm, d, q):
        th=s.p*thm; i=abc(th,d,q); T=0
        for n,E,g in s.emf:
            e=phases(th,n,E,g); T=T+sum(x*y for x,y in zip(e,i))
        return T+sum(A*sin(n*th+g) for n,A,g in s.cog)
    def angle_read(s, thm): return thm+np.radians(.25)*sin(thm+2)+np.radians(.08)*sin(2*thm)
    czero=np.radians(5.)     # electrical: commutation is off by this
    gain=(1.01,.99); off=(.02,-.012)
def sensors_H(s, thm, dm, qm):   # measured dq is what the loop holds: true currents
    th_r=s.p*s.angle_read(thm); m=abc(th_r,dm,qm)
    t=[(m[k]-s.off[k])/s.gain[k] for k in range(3)]
    z=sum(t)/3; t=[x-z for x in t]                 # star
    return dq(s.p*thm,*t)
