import numpy as np
def B2(te,id_,iq,k=1.0):
    "IPM mirror symmetric, milder saturation; all from a co-energy"
    p=4; psi=0.085*k; Ld=0.9e-3; Lq=2.0e-3/np.sqrt(1+(iq/170.)**2)+0.1e-3*np.tanh(id_/120)
    sd=1/np.sqrt(1+(iq/400.)**2)
    T=1.5*p*((psi*sd+(Ld-Lq)*id_)*iq); q=iq/100; d=id_/100
    T=T+k*(0.55*np.sin(12*te)-0.16*np.sin(24*te)+0.06*np.sin(6*te))
    s=1/np.sqrt(1+0.3*q*q)
    T=T+k*q*s*(1.3*np.cos(6*te)+0.9*np.cos(12*te)-0.3*np.cos(18*te)+.2*np.cos(24*te))
    T=T+d*q*(0.7*np.cos(6*te)-0.5*np.cos(12*te))+d*(0.5*np.sin(6*te)+0.3*np.sin(12*te))+q*q*s*(0.35*np.sin(6*te)-0.25*np.sin(12*te))
    return T
