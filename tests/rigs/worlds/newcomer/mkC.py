import subprocess,numpy as np,io,os
B="motor=2 fs=8000 bw=600 ga=0.004 gb=-0.003 oa=0.01 ob=-0.006 inoise=0.01 tnoise=0.004 toff=0.02 tgain=0.01 e1=0.0008 lag=0.0005 skip=0.5 "
def sim(args,exe='./sim'):
    o=subprocess.run([exe]+B.split()+args.split(),capture_output=True,text=True,check=True).stdout
    n=o[:o.index('\n')].split(',');a=np.loadtxt(io.StringIO(o),delimiter=',',skiprows=1)
    return {k:a[:,i] for i,k in enumerate(n)}
def sync(a,N=1024,turns=6):
    u=a['menc']/(2*np.pi)*N
    if u[-1]>u[0]: g=np.arange(np.ceil(u[0]),np.floor(u[-1]))[:turns*N];k=np.searchsorted(u,g)
    else: g=np.arange(np.floor(u[0]),np.ceil(u[-1]),-1)[:turns*N];k=np.searchsorted(-u,-g)
    k=k.clip(0,len(u)-1)
    return {x:y[k] for x,y in a.items()}|{'grid':g/N*360}
def de(f,blocks,thousands=True,time=False,head=True,cur=True,torque=True,enc='cp1252'):
    d=lambda x,n:('%.*f'%(n,x)).replace('.',',')
    with open(f,'w',encoding=enc,newline='') as o:
        if head:o.write('Prüfprotokoll EOL-Prüfstand 3;;;;;;;\r\nPrüfling;SM-0906-3,0;;;;;;\r\nDatum;03.11.2026;09:12:44;;;;;\r\nPrüfer;Müller;;;;;;\r\n;;;;;;;\r\n')
        o.write('Nr.;'+('Zeit [s];' if time else '')+'Winkel [°];'+('Drehmoment [Nm];' if torque else '')+('Strom U [A];Strom V [A];Strom W [A];' if cur else '')+'Drehzahl [1/min];Temperatur [°C]\r\n')
        n=0;t0=0
        for a in blocks:
            for i in range(len(a['t'])):
                n+=1;s=f'{n:,}'.replace(',','.') if thousands else str(n)
                o.write(s+';'+(d(t0+a['t'][i]-a['t'][0],4)+';' if time else '')+d(a['grid'][i]%360,3)+';'+(d(a['torque'][i],4)+';' if torque else '')+((d(a['ia'][i],3)+';'+d(a['ib'][i],3)+';'+d(a['ic'][i],3)+';') if cur else '')+d(a['rpm'][i],1)+';'+d(23.4+n*1e-5,1)+'\r\n')
            t0+=a['t'][-1]-a['t'][0]+3
if __name__=='__main__':
    R={'leer_re':'rpm=30 open=1 seed=1','leer_li':'rpm=-30 open=1 seed=2','l2':'rpm=30 iq=2 seed=3','l4':'rpm=30 iq=4 seed=4','l6':'rpm=30 iq=5.5 seed=5','l4li':'rpm=-30 iq=4 seed=6'}
    S={n:sync(sim('T=13 '+r)) for n,r in R.items()}
    for n in S: de(f'C/{n}.csv',[S[n]])
    de('C/alles.csv',list(S.values())); de('C/alles_zeit.csv',list(S.values()),time=True)
    de('C/leer_ohneStrom.csv',[S['leer_re']],cur=False)
    de('C/leer_li_ohneStrom.csv',[S['leer_li']],cur=False)
    de('C/mittel.csv',[{k:(v[:1024*6].reshape(6,1024).mean(0) if k not in('grid',) else v[:1024]) for k,v in S['l4'].items()}])
    for n in S:
        a=S[n];k=np.ptp(a['Ttrue']);print(n,a['Ttrue'].mean(),k)
