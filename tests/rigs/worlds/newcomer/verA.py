from ver import *
import sys
folder=sys.argv[1];extra=' '.join(sys.argv[2:])
period=build(folder+'/table')
B="motor=0 bw=400 skip=1.3 rpm=60 T=3.3 ";sens=" ga=0.005 gb=-0.004 gc=0.003 oa=0.08 ob=-0.05 oc=0.02 inoise=0.15 e2=0.0014"
for lab,x in (('ideal sensors, loop',''),('with sensor errors, loop',sens)):
    a=run('./simt',B+x+f' table=1 period={period} '+extra);m,r=pp(a)
    print('  table %-26s mean %.3f pp %.3f  '%(lab,m,r),orders(a,4))
import json
s=json.load(open(folder+'/summary.json'))
cf=folder+'/currents/currents.csv'
import csv
f=[r for r in csv.DictReader(open(cf)) if float(r['order'])==1 and r['set']=='pos'][0]
A,ph=float(f['amplitude_A']),float(f['phase_rad'])
a=run('./sim',B+f' id={-A*np.sin(ph)} iq={A*np.cos(ph)} '+extra);m,r=pp(a);print('  plain sine of same fundamental (%.1f A %.1f deg): mean %.3f pp %.3f'%(A,np.degrees(ph),m,r))
e=s['expected'];print('  stated: verdict',s['verdict'],'| before',round(s['before']['peak_to_peak_Nm'],3),'after',s['after'].get('table_peak_to_peak_Nm'),'| 95%:',e['peak_to_peak_Nm_95'],'err95',e['error_peak_to_peak_Nm_95'],'mean',e['mean_Nm'],'±',e['mean_error_Nm_95'])
