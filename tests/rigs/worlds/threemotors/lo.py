# low orders only, encoder's mean half count taken into account: lo.py tab turns off g o gc oc maxorder
import sys; import numpy as np; sys.argv_=sys.argv
src=open('ev2.py').read().replace("T=ripple(m,lambda t:(dd,qq),'table through the drive')","T=m.T(dd,qq,tm); F=np.fft.rfft(T); F[0]=0; F[96*m.p:]=0; t=np.fft.irfft(F,20000); print('orders to 96: mean %.5g pk-pk %.4g'%(T.mean(),np.ptp(t))); sys.exit()")
exec(src)
