import subprocess,json,re,os,sys
B=['cv_base_%d.csv'%k for k in range(4)]
hdr=open(B[0]).readline().strip().split(',')
def mod(tag,fn,which=range(4)):
    out=[]
    for k in range(4):
        if k not in which: out.append(B[k]); continue
        L=open(B[k]).read().strip().split('\n'); h=L[0].split(','); rows=[list(map(float,l.split(','))) for l in L[1:]]
        h,rows=fn(h,rows); n='m_%s_%d.csv'%(tag,k); out.append(n)
        open(n,'w').write(','.join(h)+'\n'+'\n'.join(','.join('%.5g'%x if abs(x)<1e4 else '%.2f'%x for x in r) for r in rows)+'\n')
    return out
S=dict(pp='--pole-pairs 5',sl='--slots 12',k='--torque-constant 0.82',r='--rated-current 5')
def run(tag,files,**kw):
    s=dict(S); s.update(kw); 
    cmd='nice hci-solve tune %s %s -o mm_%s'%(' '.join(files),' '.join(v for v in s.values() if v),tag)
    p=subprocess.run(cmd,shell=True,capture_output=True,text=True)
    o=p.stdout.split('\n'); head=[]
    for l in o:
        if not l.strip() or l.startswith('What was read'): break
        if 'current loop adds' in l: continue
        head.append(l[:330])
    f=[l for l in head if not l.startswith('      ') or '=' in l][:7]
    print('##',tag,'| EXIT',p.returncode,'\n   ','\n    '.join(f),'\n    ERR',p.stderr.strip()[:300] if p.returncode>1 else '',flush=True)
def col(h,n): return h.index(n)
def scale(n,f): 
    def g(h,rows):
        for c in n: 
            k=h.index(c)
            for r in rows: r[k]*=f
        return h,rows
    return g
def swap(a,b):
    def g(h,rows):
        i,j=h.index(a),h.index(b); h=h[:]; h[i],h[j]=h[j],h[i]; return h,rows
    return g
def ren(a,b): return lambda h,rows:([b if x==a else x for x in h],rows)
def off(n,o):
    def g(h,rows):
        k=h.index(n)
        for r in rows: r[k]+=o
        return h,rows
    return g
def drop(n):
    def g(h,rows):
        k=h.index(n); return h[:k]+h[k+1:],[r[:k]+r[k+1:] for r in rows]
    return g
M={
'01poles':lambda t:run(t,B,pp='--pole-pairs 10'),
'02pp4':lambda t:run(t,B,pp='--pole-pairs 4'),
'03torque_sign':lambda t:run(t,mod(t,scale(['torque_Nm'],-1))),
'04cur_sign':lambda t:run(t,mod(t,scale(['ia_A','ib_A','ic_A'],-1))),
'05deg_as_rad':lambda t:run(t,mod(t,ren('theta_m_deg','theta_m_rad'))),
'06rad_as_deg':lambda t:run(t,mod(t,scale(['theta_m_deg'],3.14159265/180))),
'07rms':lambda t:run(t,mod(t,scale(['ia_A','ib_A','ic_A'],.70710678))),
'08swap_bc':lambda t:run(t,mod(t,swap('ib_A','ic_A'))),
'09cycl':lambda t:run(t,mod(t,lambda h,r:swap('ia_A','ib_A')(*swap('ib_A','ic_A')(h,r)))),
'10tq_speed':lambda t:run(t,mod(t,swap('torque_Nm','speed_rpm'))),
'11mNm':lambda t:run(t,mod(t,scale(['torque_Nm'],1000))),
'12mA':lambda t:run(t,mod(t,scale(['ia_A','ib_A','ic_A'],1000))),
'13kv_x10':lambda t:run(t,B,k='--torque-constant 8.2'),
'14kt_rms':lambda t:run(t,B,k='--torque-constant 1.16'),
'15kv_as_kt':lambda t:run(t,B,k='--kv 0.82'),
'16elec_angle':lambda t:run(t,mod(t,scale(['theta_m_deg'],5))),
'17zero_d':lambda t:run(t,mod(t,off('theta_m_deg',36.))),
'18zero_q':lambda t:run(t,mod(t,off('theta_m_deg',18.))),
'19zero10':lambda t:run(t,mod(t,off('theta_m_deg',2.))),
'20dirtheta':lambda t:run(t,mod(t,scale(['theta_m_deg'],-1))),
'21no_pp':lambda t:run(t,B,pp=''),
'22no_kv':lambda t:run(t,B,k=''),
'23slots':lambda t:run(t,B,sl='--slots 9'),
'24one_file_sign':lambda t:run(t,mod(t,scale(['torque_Nm'],-1),[2])),
'25one_file_idx':lambda t:run(t,mod(t,off('theta_m_deg',11.),[3])),
'26time_ms':lambda t:run(t,mod(t,scale(['time_s'],1000))),
'27notime':lambda t:run(t,mod(t,lambda h,r:drop('speed_rpm')(*drop('time_s')(h,r)))),
'28force_as_torque':lambda t:run(t,mod(t,scale(['torque_Nm'],1/0.12))),
'29ic_missing_b_twice':lambda t:run(t,mod(t,lambda h,r:(h,[x[:5]+[x[4]]+x[6:] for x in r]))),
'30cmd_torque':lambda t:run(t,mod(t,lambda h,r:(h,[x[:6]+[round(x[6],0)] for x in r]))),
'31ratedA_mA':lambda t:run(t,B,r='--rated-current 5000'),
'32oldlog_empty':lambda t:run(t,['nofile.csv']),
}
if __name__=="__main__":
  for k,v in M.items():
      if len(sys.argv)<2 or k[:2] in sys.argv[1:]: 
          try: v(k)
          except Exception as e: print('PY',k,e)
