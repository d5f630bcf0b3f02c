import csv
H=open('C/alles_zeit.csv',encoding='cp1252',newline='').read().split('\r\n');h=H[:6];R=[r for r in H[6:] if r]
B=[R[i*6144:(i+1)*6144] for i in range(6)]
def w(f,idx,cont=False):
    o=h[:];ang=None
    for i in idx:o+=B[i]
    open(f,'w',encoding='cp1252',newline='').write('\r\n'.join(o)+'\r\n')
w('C/one_fwd.csv',[0,2,3,4]); w('C/one_2.csv',[0,4]); w('C/one_idles.csv',[0,1]);w('C/one_l.csv',[2,3,4]);w('C/one_fwdback4.csv',[3,5])
