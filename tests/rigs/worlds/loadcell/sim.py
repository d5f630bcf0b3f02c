import numpy as np, csv, sys, os
R=np.random.default_rng
def har(th,l):  # list (n,A,ph)
    s=0*th
    for n,A,g in l: s=s+A*np.sin(n*th+g)
    return s
def ph(id_,iq,te):
    s=2*np.pi/3
    return [iq*np.sin(te-k*s)-id_*np.cos(te-k*s) for k in range(3)]
def park(ia,ib,ic,te):
    s=2*np.pi/3
    iq=2/3*(ia*np.sin(te)+ib*np.sin(te-s)+ic*np.sin(te+s)); id_=-2/3*(ia*np.cos(te)+ib*np.cos(te-s)+ic*np.cos(te+s))
    return id_,iq
class PM:
    def __init__(s,p,ke,cog,emf=(),fric=0,visc=0,J=1e-4,Lrel=0,imb=(1,1,1),sat=0,isat=1): s.__dict__.update(locals())
    def air(s,tm,i3):
        te=s.p*tm; T=0; d=2*np.pi/3
        for k in range(3):
            x=te-k*d
            T=T+s.imb[k]*i3[k]*(s.ke*np.sin(x)+har(x,[(n,s.ke*A,g) for n,A,g in s.emf]))
        id_,iq=park(*i3,te)
        T=T*(1-s.sat*((id_**2+iq**2)/s.isat**2))+1.5*s.p*s.Lrel*id_*iq
        return T+har(tm,s.cog)    # cog: mechanical orders
A=PM(7,2/3*0.0435,[(84,0.0062,1.1),(12,0.0016,0.4),(168,0.0011,-0.7),(14,0.0009,2.0)],[(5,0.031,0.0+np.pi),(7,0.016,0.1),(11,.006,0)],0.006,2e-5,6e-5)
C=PM(5,2/3*0.82,[(60,0.045,0.7),(120,0.011,-0.9),(10,0.008,0.2),(12,0.012,-1.4)],[(5,0.022,0.3),(7,0.013,np.pi-0.2),(11,0.006,1.),(13,.004,0)],0.05,0.002,4e-4,sat=0.06,isat=8.)
def B(te,id_,iq):
    "IPM 4pp torque, shaft N.m; analytical saturation"
    p=4; psi=0.085; Ld=0.9e-3; Lq0=2.4e-3
    Lq=Lq0/np.sqrt(1+(iq/90.)**2)+0.15e-3*np.tanh(id_/80)
    sd=1/np.sqrt(1+(iq/260.)**2)
    T=1.5*p*((psi*sd+(Ld-Lq)*id_)*iq)
    q=iq/100; d=id_/100
    T=T+0.55*np.sin(12*te+0.4)+0.16*np.sin(24*te-1.1)+0.06*np.sin(6*te+1)
    T=T+q*(1.3*np.sin(6*te+0.2)+0.9*np.sin(12*te-0.8)+0.3*np.sin(18*te+.4)+.2*np.sin(24*te))/np.sqrt(1+0.4*q*q)
    T=T+d*q*(0.7*np.sin(6*te+2)+0.5*np.sin(12*te+0.1))+d*(0.5*np.cos(6*te+.3)+0.3*np.cos(12*te))+q*q*(0.35*np.cos(6*te)+0.25*np.cos(12*te+1))
    return T
