from ver import *
import sys
folder=sys.argv[1];extra=' '.join(sys.argv[2:])
f=folder+'/table' if os.path.isdir(folder+'/table') else folder
period=build(f,exe='./simtb')
B="motor=1 bw=1000 skip=3.3 rpm=20 T=9.4 fs=10000 ";sens=" counts=16384 e1=0.006 e2=0.002 ga=0.01 gb=-0.01 oa=0.05 ob=-0.03 inoise=0.04 "
for lab,x in (('ideal sensors, ideal I','ideal=1 '),('sensor errors, loop',sens),):
    a=run('./simtb',B+x+f' table=1 period={period} '+extra);m,r=pp(a)
    print('  table %-26s mean %.5f pp %.5f  '%(lab,m,r),orders(a,7,8))
s=json.load(open(folder+'/summary.json'))
import csv
fr=[r for r in csv.DictReader(open(folder+'/currents/currents.csv')) if float(r['order'])==1 and r['set']=='pos'][0]
A,ph=float(fr['amplitude_A']),float(fr['phase_rad'])
a=run('./sim',B+f' id={-A*np.sin(ph)} iq={A*np.cos(ph)} '+extra);m,r=pp(a);print('  plain sine (%.2f A %.1f deg): mean %.5f pp %.5f'%(A,np.degrees(ph),m,r),orders(a,7,8))
e=s['expected'];print('  stated:',s['verdict'],'| before',s['before']['peak_to_peak_Nm'],'after',s['after'].get('table_peak_to_peak_Nm'),'| 95%:',e['peak_to_peak_Nm_95'])
