from sim import *; from simb import B2
rows=[]
for I in (0,45,90,135,180):
  for beta in ((0,) if I==0 else (-15,0,15,30,45,60)):
    b=np.deg2rad(beta)
    for a in np.arange(0,120.01,2.5): rows.append((a,-I*np.sin(b),I*np.cos(b),B2(np.deg2rad(a),-I*np.sin(b),I*np.cos(b))))
r=R(3)
with open('b_fe2.csv','w') as f:
    f.write('Rotor Position;Id (Peak);Iq (Peak);Torque (VW)\nEDeg;Amps;Amps;Nm\n')
    for a,d,q,T in rows: f.write('%.4g;%.4f;%.4f;%.5f\n'%(a,d,q,T+r.normal(0,0.004)))
