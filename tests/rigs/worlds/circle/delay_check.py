# b01b says: "add to the angle (read late) the speed times -0.00028238 s". The plant's angle is not late (the torque sensor lags 0.4 ms, sampled 0.1 ms later). What does that 'correction' do?
from plant import *
tab,per,h=read_table('lists/b01b/t/table');per=per or 1
for r in (60,300,1500,3000):
    e=-5*r*2*np.pi/60*2.8238e-4
    P=Plant('servo',fang=.02);Q=Plant('servo',fang=.02,offe=e,zlog=0)
    # drive frame and table index both turned by e: index offset via zlog=e/5
    Q=Plant('servo',fang=.02,offe=e,zlog=e/5)
    y0=P.static(tab,per);y=Q.static(tab,per);print('%d rpm: turned %.1f deg el; ripple without the correction %.4f, with it %.4f N m; mean %.4f -> %.4f'%(r,e*180/np.pi,pp(y0),pp(y),y0.mean(),y.mean()))
