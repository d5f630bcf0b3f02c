# Motor 3: interior PM, 3 pole pairs (54 slots: lcm(54,6)=54 -> elec 18), co-energy of my own. SECRET.
import numpy as np, math, os
P=3
PSI=0.118; LD=2.1e-3; LQ0=5.2e-3; IQS=55.0; LQ1=2.4e-3; KX=0.0035
def W(d,q,th,dev=0.0):
    psi=PSI*(1-0.02*dev)
    w=psi*d+0.5*LD*d*d/(1+0.002*np.sqrt((d+20)**2+900)) + LQ1*q*q/2 + (LQ0-LQ1)*IQS**2*(np.sqrt(1+(q/IQS)**2)-1)*(1-KX*d/(1+0.004*np.sqrt(d*d+q*q)))
    # position harmonics
    c6=(0.5e-3+4e-6*q+2e-6*d)*(1+0.05*dev); s=np.tanh(q/60)
    w=w+(c6*d*np.cos(6*th+0.2)+ 0.9e-3*q/(1+np.sqrt(q*q+400)/120)*np.sin(6*th-0.15*s)+0.3e-3*q*np.sin(12*th+0.3)*(1-0.3*s*s)+0.2e-3*d*np.cos(12*th)+ 0.00012*q*np.sin(18*th+1.0))
    w=w+ (0.006*(1+0.2*dev)*np.cos(18*th+0.4)+0.0012*np.cos(36*th+1.1))*(1+0.15*(d/60)-0.2*(q/90)**2)
    return 1.5*w
def T(d,q,th,dev=0.0,h=1e-4):
    d=np.asarray(d,float);q=np.asarray(q,float)
    wd=(W(d+h,q,th,dev)-W(d-h,q,th,dev))/(2*h); wq=(W(d,q+h,th,dev)-W(d,q-h,th,dev))/(2*h); wt=(W(d,q,th+h/10,dev)-W(d,q,th-h/10,dev))/(2*h/10)
    return P*(wd*q-wq*d+wt)
if __name__=='__main__':
    os.makedirs('../m3',exist_ok=True)
    # Motor-CAD/JMAG style torque map: one electrical period/ 60 deg, 1 deg mech... angles of elec degrees 0..60 step 1
    ids=[-90,-60,-30,0,30]; iqs=[0,30,60,90,120]
    rows=[]
    for i in ids:
        for q in iqs:
            for k in range(0,121):
                a=k*1.0  # elec deg
                rows.append((a/P,a,i,q,float(T(i,q,math.radians(a)))))
    with open('../m3sm/map_jmag.csv','w') as f:
        f.write('Study,IPM_54s6p\nDesign,Torque map\n')
        f.write('Rotor angle[deg],Id[A],Iq[A],Torque[N*m]\n')
        for r in rows: f.write('%.6g,%g,%g,%.6g\n'%(r[0],r[2],r[3],r[4]))
    with open('../m3sm/map_mcad.csv','w') as f:
        f.write('Rotor Position (EDeg);Id (Peak);Iq (Peak);Torque\nEDeg;Amps;Amps;Nm\n')
        for r in rows: f.write('%g;%g;%g;%.6g\n'%(r[1],r[2],r[3],r[4]))
    # FEMM script: a file per operating point
    for i,q in ((0,0),(0,45),(0,90),(-45,60),(-60,100),(30,60),(-30,90)):
        with open('../m3sm/femm_id%g_iq%g.csv'%(i,q),'w') as f:
            f.write('theta_m_deg,id_A,iq_A,torque_Nm\n')
            for k in range(0,361): f.write('%.6f,%g,%g,%.6f\n'%(k/P,i,q,float(T(i,q,math.radians(k)))))
    # bench logs: dev=1 real machine, transducer
    rng=np.random.default_rng(3)
    def bench(name,d,q,rpm,turns=6,zero=0.15,fric=0.25):
        fs=2000; n=int(turns/abs(rpm)*60*fs); t=np.arange(n)/fs; thm=rpm*math.pi/30*t+0.4
        y=T(d+0*t,q+0*t,P*thm,1.0)-np.sign(rpm)*fric+zero+rng.normal(0,0.06,n)
        with open('../m3sm/%s.csv'%name,'w') as f:
            f.write('time_s,theta_m_deg,id_A,iq_A,torque_Nm,speed_rpm\n')
            for k in range(n): f.write('%.5f,%.3f,%.3f,%.3f,%.4f,%.2f\n'%(t[k],np.degrees(thm[k])%360,d+rng.normal(0,.1),q+rng.normal(0,.1),y[k],rpm+rng.normal(0,.1)))
    bench('bench_1',0,60,60); bench('bench_2',-45,80,-60); bench('bench_0',0,0,60)
